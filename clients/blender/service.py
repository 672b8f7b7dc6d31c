"""A Nacreous service: its presets, and their textures.

``GET {server}/v1/presets`` lists objects with a ``name``; ``GET {server}/v1/presets/{name}.exr`` is the
texture of R, and ``{name}.transmission.exr`` that of T, which only films have that transmit (404 otherwise).
"""

import json
import re
from dataclasses import dataclass
from http import HTTPStatus
from http.client import HTTPException
from pathlib import Path
from tempfile import TemporaryDirectory
from urllib.error import HTTPError, URLError
from urllib.parse import quote, urlsplit
from urllib.request import (
    HTTPDefaultErrorHandler,
    HTTPErrorProcessor,
    HTTPHandler,
    HTTPRedirectHandler,
    HTTPSHandler,
    OpenerDirector,
    ProxyHandler,
)

from .lookup_texture import TEXTURE_SUFFIX, TRANSMISSION_SUFFIX, LookupTexture

SCHEMES = ("http", "https")
TIMEOUT_SECONDS = 20.0
LARGEST_LIST_BYTES = 4 * 2**20
LARGEST_TEXTURE_BYTES = 256 * 2**20
PRESET_NAME = re.compile(r"[A-Za-z0-9][\w.-]*(/[A-Za-z0-9][\w.-]*)*", re.ASCII)
"""Words with slashes between, such as paper/figure-3: nothing that leaves the folder it is written to."""


class ServiceError(RuntimeError):
    """The service did not answer as expected; the message is for the artist."""


class NotFoundError(ServiceError):
    """The service has no such file."""


@dataclass(frozen=True)
class Service:
    """A service and where it is.

    Parameters
    ----------
    address : str
        Such as ``http://localhost:8000``.
    """

    address: str

    def __post_init__(self) -> None:
        if urlsplit(self.address).scheme not in SCHEMES or not urlsplit(self.address).hostname:
            raise ServiceError(f"Expected an address with http:// or https://, got {self.address!r}")

    def presets(self) -> tuple[str, ...]:
        """Return the presets' names in the order of the service; raises `ServiceError`."""
        body = self._get("/v1/presets", LARGEST_LIST_BYTES)
        try:
            names = tuple(str(preset["name"]) for preset in json.loads(body))
        except (ValueError, TypeError, KeyError, RecursionError):
            raise ServiceError(f"{self.address} answers without a list of presets: is it Nacreous?") from None
        return tuple(filter(PRESET_NAME.fullmatch, names))

    def download(self, preset: str, folder: Path) -> Path:
        """Write a preset's textures into `folder`, and return that of R.

        What was there before stays until everything has come and is a lookup texture. Raises `ServiceError`
        and `TextureError`.
        """
        if not PRESET_NAME.fullmatch(preset):
            raise ServiceError(f"{preset!r} is no name of a preset")
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with TemporaryDirectory(dir=folder, prefix=".nacreous-") as arriving:
                return self._fetch(preset, Path(arriving), folder)
        except OSError as error:
            raise ServiceError(f"Cannot write into {folder}: {error.strerror}") from None

    def _fetch(self, preset: str, arriving: Path, folder: Path) -> Path:
        stem = preset.replace("/", "-")
        path = arriving / f"{stem}{TEXTURE_SUFFIX}"
        path.write_bytes(self._texture(preset, TEXTURE_SUFFIX))
        LookupTexture.read(path)
        transmission = arriving / f"{stem}{TRANSMISSION_SUFFIX}"
        try:
            transmission.write_bytes(self._texture(preset, TRANSMISSION_SUFFIX))
        except NotFoundError:
            (folder / transmission.name).unlink(missing_ok=True)
        for file in arriving.iterdir():
            file.replace(folder / file.name)
        return folder / path.name

    def _texture(self, preset: str, suffix: str) -> bytes:
        return self._get(f"/v1/presets/{quote(preset)}{suffix}", LARGEST_TEXTURE_BYTES)

    def _get(self, route: str, largest_bytes: int) -> bytes:
        url = self.address.rstrip("/") + route
        try:
            with _opener().open(url, timeout=TIMEOUT_SECONDS) as answer:
                body = answer.read(largest_bytes + 1)
                missing_bytes = answer.length or 0
        except HTTPError as error:
            kind = NotFoundError if error.code == HTTPStatus.NOT_FOUND else ServiceError
            raise kind(f"{url} answered {error.code} {error.reason}") from None
        except URLError as error:
            raise ServiceError(f"Cannot reach {self.address}: {error.reason}") from None
        except (OSError, HTTPException, ValueError) as error:
            raise ServiceError(f"{url} broke off: {error}") from None
        if len(body) > largest_bytes:
            raise ServiceError(f"{url} is larger than {largest_bytes // 2**20} MiB")
        if missing_bytes:
            raise ServiceError(f"{url} broke off: {missing_bytes} bytes are missing")
        return body


def _opener() -> OpenerDirector:
    """Open http and https alone, also after a redirection: urllib's usual opener reads files and FTP too."""
    opener = OpenerDirector()
    for handler in (
        ProxyHandler,
        HTTPHandler,
        HTTPSHandler,
        HTTPDefaultErrorHandler,
        HTTPRedirectHandler,
        HTTPErrorProcessor,
    ):
        opener.add_handler(handler())
    return opener
