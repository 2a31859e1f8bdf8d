"""Pieces of SVG."""

from __future__ import annotations

from html import escape

INK, GRID, GREY = "#282c34", "#e2e5e9", "#6b7280"
ALONE, SHARED, WATCHED, QUIET, FAILED = "#d55e00", "#0072b2", "#f0c29b", "#d3dce3", "#282c34"
"""Colours: a robot's own alarm, one of its group, a name that is watched, silence, no diagnosis."""


def text(x: float, y: float, words: str, *, anchor: str = "start", size: int = 12, ink: str = INK) -> str:
    """A line of text that stands at y."""
    place = f'x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{ink}" text-anchor="{anchor}"'
    return f'<text {place} font-family="sans-serif">{escape(words)}</text>'


def slanted(x: float, y: float, words: str) -> str:
    """A line of text that rises from x, y."""
    turn = f'transform="translate({x:.1f},{y:.1f}) rotate(-40)"'
    return f'<text {turn} font-size="12" fill="{INK}" font-family="sans-serif">{escape(words)}</text>'


def rectangle(
    x: float, y: float, width: float, height: float, fill: str, title: str = "", *, framed: bool = False
) -> str:
    """A filled rectangle, perhaps in a frame, with words for who points at it."""
    place = f'x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{fill}"'
    place += f' stroke="{INK}" stroke-width="2"' if framed else ""
    return f"<rect {place}><title>{escape(title)}</title></rect>" if title else f"<rect {place}/>"


def line(x1: float, y1: float, x2: float, y2: float, stroke: str = GRID) -> str:
    """A straight line."""
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{stroke}"/>'


def picture(width: float, height: float, parts: list[str]) -> str:
    """The whole picture."""
    size = f'viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" height="{height:.0f}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>' + "\n".join(parts) + "</svg>"


def legend(y: float, entries: list[tuple[str, str]]) -> list[str]:
    """Colours with their meaning, in a line."""
    parts, x = [], 0.0
    for colour, words in entries:
        parts += [rectangle(x, y - 10, 11, 11, colour), text(x + 16, y, words)]
        x += 34 + 6.6 * len(words)
    return parts
