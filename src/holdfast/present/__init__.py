"""What people look at: pages, figures and console text of what the packages below compute."""
