from holdfast.shapes.pieces import Missing as Missing
from holdfast.shapes.pieces import Piece as Piece
from holdfast.shapes.reading import read_pieces as read_pieces
from holdfast.shapes.reading import unchecked_pairs as unchecked_pairs
