"""Pack the add-on as an extension that Blender installs: python pack.py [FOLDER].

`blender --command extension build` takes files of this folder alone, and the OSL shader lies beside it.
"""

import sys
import tomllib
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

HERE = Path(__file__).parent
NOT_OF_THE_ADD_ON = {"pack.py", "example.py"}


def pack(folder: Path) -> Path:
    """Write ``nacreous-VERSION.zip`` into `folder` and return it."""
    manifest = HERE / "blender_manifest.toml"
    version = tomllib.loads(manifest.read_text())["version"]
    modules = (path for path in sorted(HERE.glob("*.py")) if path.name not in NOT_OF_THE_ADD_ON)
    archive = folder / f"nacreous-{version}.zip"
    folder.mkdir(parents=True, exist_ok=True)
    with ZipFile(archive, "w", ZIP_DEFLATED) as packed:
        for path in (manifest, *modules, HERE / "README.md", HERE.parent / "osl" / "nacreous_film.osl"):
            packed.write(path, path.name)
    return archive


if __name__ == "__main__":
    print(pack(Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
