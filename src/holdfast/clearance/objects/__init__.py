"""What an arm meets in a cell, by how its distance is told."""
