"""Pictures of what controllers trade."""
