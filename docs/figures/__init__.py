"""The figures of Wu & Zheng 2015, rendered by Mitsuba 3 from the tables of Nacreous.

`make figures`, or `python -m figures [3 4 ...]` with docs and tests on the path. Each figure is a module with
what the paper shows and says, how it is rendered, and what is found: `figure.Figure` is their common form,
`registry.FIGURES` their list. Pictures go to docs/images/figures, findings into docs/paper.md.
"""
