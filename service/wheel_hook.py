"""What the table of sources in pyproject.toml cannot say of the wheel; hatchling calls this while it builds.

`nacreous_client` lies in `clients/`, all of which becomes `nacreous/clients`, and has to be importable: a
wheel holds it as a package of its own. An editable installation has its folder on the path instead.
"""

from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

__all__ = ["WheelHook"]


class WheelHook(BuildHookInterface):
    """Adds the client in Python to a wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add it, unless the wheel is one of an editable installation."""
        if version == "standard":
            build_data["force_include"]["clients/python/nacreous_client"] = "nacreous_client"
