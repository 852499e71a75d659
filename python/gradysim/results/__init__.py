"""What a run leaves behind, in the same shape for both modes."""
