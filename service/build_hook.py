"""What tables in pyproject.toml cannot say of a wheel and an sdist; hatchling calls this while it builds.

Both hold the page of the service as it is built from `service/page`, so that what is installed from either
has it; an editable installation builds it beside its sources.

`nacreous_client` lies in `clients/`, all of which becomes `nacreous/clients`, and has to be importable: a
wheel holds it as a package of its own. An editable installation has its folder on the path instead.
"""

import runpy
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

__all__ = ["BuildHook"]


class BuildHook(BuildHookInterface):
    """Builds the page, and adds the client in Python to a wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the one; add the other, unless the wheel is one of an editable installation."""
        runpy.run_path(str(Path(self.root, "service", "page", "build.py")))["build"]()
        if self.target_name == "wheel" and version == "standard":
            build_data["force_include"]["clients/python/nacreous_client"] = "nacreous_client"
