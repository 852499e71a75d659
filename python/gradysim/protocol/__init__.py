"""What users write protocols against. It knows no environment: the same protocol runs in all of them."""
