"""Specs as their users write them: in TOML, whole, and in JSON, right but for what is put in."""

__all__ = ["FILM", "LAYER", "ROUGH", "STACK", "film", "layer", "table"]

STACK = """
[stack]
incident = "air"
substrate = { n = 1.5 }
[[stack.layers]]
material = { n = 2.0 }
thickness_nm = 420.0
"""
FILM = f"""{STACK}
[table]
cos_theta = 9
"""
ROUGH = f"""{STACK.replace("{ n = 1.5 }", '"main/Ag/Johnson"')}
[surface]
alpha_x = 0.4
[table]
quantity = "bsdf"
theta_i = 3
theta_o = 3
phi = 3
"""

LAYER = '{"material": {"n": 2.0}, "thickness_nm": 420}'


def film(layers: str = LAYER, rest: str = "") -> str:
    """Return a spec as JSON text whose layers are as given, and what comes after its stack."""
    return f'{{"stack": {{"incident": "air", "substrate": {{"n": 1.5}}, "layers": [{layers}]}}{rest}}}'


def layer(thickness: str = "420", material: str = '{"n": 2.0}', rest: str = "") -> str:
    """Return a spec whose one layer is as given."""
    return film(f'{{"material": {material}, "thickness_nm": {thickness}{rest}}}')


def table(fields: str) -> str:
    """Return a spec whose table is as given."""
    return film(rest=f', "table": {{{fields}}}')
