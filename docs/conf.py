"""The site, as Sphinx builds it: `make docs`, or `sphinx-build -W --keep-going -n docs build/site`."""

import sys
from pathlib import Path

DOCS = Path(__file__).parent
ROOT = DOCS.parent
sys.path[:0] = [str(DOCS), str(ROOT / "service"), str(ROOT / "clients" / "python")]

project = "Nacreous"
author = "The Nacreous contributors"
copyright = author  # noqa: A001 - the name that Sphinx has for it
html_title = "Nacreous"
language = "en"
smartquotes_action = "q"  # quotes alone: two hyphens begin an option
toc_object_entries_show_parents = "hide"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_design",
    "nacreous_site",
]
source_suffix = {".md": "markdown"}
exclude_patterns = ["images", "nacreous_site", "figures", "validation"]

# ---- Markdown ----------------------------------------------------------------------------------------------

myst_enable_extensions = ["attrs_block", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
# Braces and dollars are data in most of the pages: `{ n = 1.5 }`, and prices nowhere.
myst_dmath_double_inline = True
myst_dmath_allow_digits = False
# Both packages have a SpecError. Docstrings name it without its package; the one found first is meant.
suppress_warnings = ["ref.python"]

# ---- Python ------------------------------------------------------------------------------------------------

default_role = "code"
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings have the types
napoleon_google_docstring = False
napoleon_use_rtype = False
# Types of other projects, and words of numpy's docstrings: nothing on this site describes them.
nitpick_ignore_regex = [("py:.*", r"(?!nacreous).*")]

# ---- HTML --------------------------------------------------------------------------------------------------

html_theme = "pydata_sphinx_theme"
html_math_renderer = "mathml"
html_favicon = html_logo = "../service/page/src/icon.svg"
html_static_path = ["_static"]
html_css_files = ["nacreous.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_context = {"default_mode": "auto"}
html_theme_options = {
    "logo": {"text": "Nacreous"},
    "navbar_align": "left",
    "navbar_end": ["theme-switcher"],
    "header_links_before_dropdown": 6,
    "show_toc_level": 2,
    "show_nav_level": 2,
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
html_sidebars = {"index": [], "gallery": []}
