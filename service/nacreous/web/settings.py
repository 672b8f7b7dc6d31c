"""What a service is told by its environment: one field a setting, ``NACREOUS_`` and its name in capitals."""

import re
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, SecretStr
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

from nacreous.optics.value import refusal, shown
from nacreous.store.store import is_folder
from nacreous.tables.spec_document import MAX_BYTES

__all__ = ["Settings"]

_GIB = 2**30
_ORIGIN = re.compile(r"https?://[^/\s]+")
_FOLDER_QUOTA = 10 * _GIB


def _default_store() -> str:
    import platformdirs

    return str(Path(platformdirs.user_data_dir("nacreous")) / "store")


def _words(value: object) -> object:
    """Read a list as people write one into an environment: with commas."""
    return tuple(filter(None, map(str.strip, value.split(",")))) if isinstance(value, str) else value


def _keys(value: object) -> object:
    """Read keys; a variable that is set and holds none would leave the service open by mistake."""
    words = _words(value)
    if isinstance(value, str) and value and not words:
        raise ValueError("a key, or nothing at all")
    return words


def _origins(origins: tuple[str, ...]) -> tuple[str, ...]:
    for origin in origins:
        if origin != "*" and not _ORIGIN.fullmatch(origin):
            raise refusal("origins as browsers send them, such as https://a.example, or *", shown(origin))
    return origins


def _long_enough(keys: tuple[SecretStr, ...]) -> tuple[SecretStr, ...]:
    if any(not 16 <= len(key.get_secret_value()) <= 512 for key in keys):
        raise ValueError("each key has 16 to 512 characters")
    return keys


_Origins = Annotated[tuple[str, ...], NoDecode, BeforeValidator(_words), AfterValidator(_origins)]
_Keys = Annotated[tuple[SecretStr, ...], NoDecode, BeforeValidator(_keys), AfterValidator(_long_enough)]


class Settings(BaseSettings):
    """Settings of the service; the environment gives those that are not given here."""

    model_config = SettingsConfigDict(env_prefix="NACREOUS_", frozen=True, extra="ignore")

    host: str = Field("127.0.0.1", description="Address to listen on; 0.0.0.0 for every one of the machine.")
    port: int = Field(8000, ge=0, le=65_535, description="Port to listen on; 0 for one that is free.")
    store: str = Field(
        default_factory=_default_store,
        description="Folder or fsspec URL, such as s3://bucket/prefix, of finished tables; a folder below "
        "the user's data without it.",
    )
    store_quota: int | None = Field(
        None,
        ge=2**20,
        description="Bytes that a folder may hold, 10 GiB without it; the least used are removed first. "
        "A bucket has rules of its own.",
    )
    api_keys: _Keys = Field((), description="Bearer keys, with commas between; without one, anybody may ask.")
    cors_origins: _Origins = Field(
        (), description="Origins whose pages may ask, with commas between, or *; none without it."
    )
    max_body: int = Field(
        MAX_BYTES, ge=2**10, le=MAX_BYTES, description="Bytes of a request's body; more is refused with 413."
    )
    body_seconds: float = Field(
        15, gt=0, le=600, description="Time in which a request's body must have come; 408 after it."
    )
    header_seconds: float = Field(
        10, gt=0, le=600, description="Time in which a request's header must have come; 408 after it."
    )
    max_header: int = Field(
        32 * 2**10, ge=2**10, le=2**20, description="Bytes of a request's header; more is refused with 431."
    )
    connections: int = Field(1000, ge=1, description="Connections at a time; more are closed at once.")
    concurrency: int = Field(
        256, ge=1, description="Requests at a time, probes aside; more are refused with 503."
    )
    queue_length: int = Field(
        64, ge=1, description="Tables that wait for the engine; more are refused with 429."
    )
    deadline_seconds: float = Field(
        60,
        gt=0,
        description="Time that a table may take; its worker is ended after it, and the answer is 504.",
    )
    synchronous_seconds: float = Field(
        2, ge=0, description="Estimate over which `POST /v1/tables` answers 202 and makes a job."
    )
    hot_bytes: int = Field(_GIB // 4, ge=0, description="Bytes of files kept in memory.")
    job_deadline_seconds: float = Field(1800, gt=0, description="Time that a table of a job may take.")
    job_tables: int = Field(10_000, ge=1, le=1_000_000, description="Tables of one job.")
    shutdown_seconds: float = Field(
        18, ge=1, le=600, description="Time from SIGTERM to the end; requests that run finish meanwhile."
    )
    log_level: Literal["debug", "info", "warning", "error"] = Field(
        "info", description="Least severity that is logged; requests are logged at info."
    )

    @property
    def quota_bytes(self) -> int | None:
        """Quota of the store: one that was set is for the store to refuse where it cannot keep it."""
        if self.store_quota is None and is_folder(self.store):
            return _FOLDER_QUOTA
        return self.store_quota

    @property
    def keys(self) -> tuple[bytes, ...]:
        """The bearer keys as a header has them."""
        return tuple(key.get_secret_value().encode() for key in self.api_keys)
