"""The realism ladder: a protocol under more and more effects of real radios and vehicles."""
