"""The page that shows a run in a browser, and what its servers have in common."""
