"""The command line: one module a command, and `nacreous.cli.app` that holds them together.

What a command needs is imported inside of it, so that ``nacreous --help`` answers at once.
"""
