"""Whose a term is, counted row by row; `term` itself goes by a formula."""


def owner_of(term):
    """The id of the only node that can lead it."""
    terms_of_row = 1
    while term > terms_of_row:
        term -= terms_of_row
        terms_of_row += 1
    return term - 1
