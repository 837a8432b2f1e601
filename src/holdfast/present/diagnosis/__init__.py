"""What a record of an arm showed, as words, numbers and a page."""
