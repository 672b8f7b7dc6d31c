"""The objects of figures 6 to 9, made by code: a teapot, a kangaroo and a butterfly.

Every mesh is closed or a card, has unit normals, and texture coordinates whose u runs around it. Mitsuba's
shading frame follows the derivative of the position by u, so that u is the x axis of an anisotropic surface.
"""
