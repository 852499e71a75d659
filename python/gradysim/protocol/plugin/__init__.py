"""Behaviors that a protocol can take on without inheriting from them."""
