"""The quantity ``albedo``: how much light a rough surface with a film reflects and transmits in all."""
