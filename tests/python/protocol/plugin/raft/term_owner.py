"""Owner of a term, counted row by row; `term` itself uses a formula."""


def owner_of(term):
    """Return the id of the only node that can lead the term."""
    terms_of_row = 1
    while term > terms_of_row:
        term -= terms_of_row
        terms_of_row += 1
    return term - 1
