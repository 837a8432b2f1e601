"""What a motion will show of locks, before it is made, and motions made to show them."""
