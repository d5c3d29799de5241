"""What holds for any errors and any columns: robust sums, least squares, how sure is sure."""
