from holdfast.model.shapes.pieces import Missing as Missing
from holdfast.model.shapes.pieces import Piece as Piece
from holdfast.model.shapes.reading import read_pieces as read_pieces
from holdfast.model.shapes.reading import unchecked_pairs as unchecked_pairs
