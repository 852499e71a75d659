"""Equipment of a node beyond its radio and its vehicle; a protocol makes an extension for itself.

An extension goes round the contract between protocol and environment, so not all of them work in every
mode; each one says in which it does.
"""
