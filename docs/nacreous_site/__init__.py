"""The extension of Sphinx that builds the site: reference pages from the code, links as on a code host.

Each page of the reference holds one directive, which is one module here. It reads what the program itself
reads, so that the page cannot say anything else.
"""

from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata

from nacreous_site.cli_reference import CliReference
from nacreous_site.format_reference import FormatReference
from nacreous_site.material_reference import MaterialReference
from nacreous_site.math_font import use_math_font
from nacreous_site.mathml import use_mathml
from nacreous_site.preset_reference import PresetReference
from nacreous_site.repository_links import use_repository_links
from nacreous_site.rest_reference import RestReference
from nacreous_site.settings_reference import SettingsReference
from nacreous_site.spec_reference import SpecReference

__all__ = ["setup"]

_DIRECTIVES = {
    "cli-reference": CliReference,
    "format-reference": FormatReference,
    "material-reference": MaterialReference,
    "preset-reference": PresetReference,
    "rest-reference": RestReference,
    "settings-reference": SettingsReference,
    "spec-reference": SpecReference,
}


def setup(app: Sphinx) -> ExtensionMetadata:
    """Add the directives, the links and the formulas to Sphinx."""
    for name, directive in _DIRECTIVES.items():
        app.add_directive(name, directive)
    use_repository_links(app)
    use_mathml(app)
    use_math_font(app)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
