"""The text of an .ini file: its lines and sections, and which sections a configuration consists of."""
