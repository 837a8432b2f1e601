"""Searches that fill the record book of holdfast: an evolution strategy, its objectives, and the arms of null spaces."""
