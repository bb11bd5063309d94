"""A `repr` for dataclasses with many fields of which few are set."""

from __future__ import annotations

from dataclasses import fields


class Shown:
    """A dataclass whose `repr` names only the fields that are set, and counts long lists."""

    def __repr__(self) -> str:
        values = {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]
        texts = [f"{name}={_text(value)}" for name, value in values.items() if value not in (None, [], {}, "")]
        return f"{type(self).__name__}({', '.join(texts)})"


def _text(value: object) -> str:
    if isinstance(value, list) and len(value) > 3:
        return f"<list of {len(value)}>"
    return repr(value)
