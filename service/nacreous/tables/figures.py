"""What a certificate is: measured errors by name."""

import json
from dataclasses import asdict, dataclass

__all__ = ["Figures"]


@dataclass(frozen=True)
class Figures:
    """Measured errors of a table; each quantity has its own."""

    def to_json(self) -> str:
        """One JSON object of the figures by name, rounded to four digits: more would be noise."""
        rounded = {k: float(f"{v:.4g}") if isinstance(v, float) else v for k, v in asdict(self).items()}
        return json.dumps(rounded, allow_nan=False)
