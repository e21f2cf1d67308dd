"""A plot with two logarithmic axes as SVG, without a library."""
import math
from dataclasses import dataclass
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 760, 480
LEFT, RIGHT, TOP, BOTTOM = 70, 190, 40, 56
COLOURS = ["#1b6ca8", "#c0392b", "#2e8b57", "#8e5ea2", "#b7791f", "#4a4a4a"]


@dataclass
class Line:
    """Points (x, y), both positive, under a label; lines of one group share a colour."""

    label: str
    group: str
    points: list
    dashed: bool = False


def decades(values):
    """The whole powers of ten that enclose the values."""
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def draw(lines, title, x_label, y_label):
    """The picture as text."""
    lines = [line for line in lines if line.points]
    if not lines:
        return '<svg xmlns="http://www.w3.org/2000/svg"/>\n'
    (x_low, x_high), (y_low, y_high) = (decades([point[k] for line in lines for point in line.points]) for k in range(2))

    def place(x, y):
        right = LEFT + (math.log10(x) - x_low) / (x_high - x_low) * (WIDTH - LEFT - RIGHT)
        down = HEIGHT - BOTTOM - (math.log10(y) - y_low) / (y_high - y_low) * (HEIGHT - TOP - BOTTOM)
        return right, down

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             f'<text x="{LEFT}" y="24" font-size="15">{escape(title)}</text>']
    parts += axes(place, (x_low, x_high), (y_low, y_high), x_label, y_label)
    groups = list(dict.fromkeys(line.group for line in lines))
    for row, line in enumerate(lines):
        colour = COLOURS[groups.index(line.group) % len(COLOURS)]
        parts += curve(line, colour, place, TOP + 20 * row)
    return "\n".join(parts + ["</svg>"]) + "\n"


def axes(place, x_range, y_range, x_label, y_label):
    """Grid lines at whole powers of ten with their numbers."""
    parts = []
    for k in range(x_range[0], x_range[1] + 1):
        x, bottom = place(10.0**k, 10.0 ** y_range[0])
        parts.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{bottom:.1f}" stroke="#ddd"/>')
        parts.append(f'<text x="{x:.1f}" y="{bottom + 18:.1f}" text-anchor="middle">{power(k)}</text>')
    for k in range(y_range[0], y_range[1] + 1):
        left, y = place(10.0 ** x_range[0], 10.0**k)
        parts.append(f'<line x1="{left:.1f}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(f'<text x="{left - 8:.1f}" y="{y + 4:.1f}" text-anchor="end">{power(k)}</text>')
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(f'<text x="{middle}" y="{HEIGHT - 12}" text-anchor="middle">{escape(x_label)}</text>')
    upright = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(f'<text transform="translate(18 {upright}) rotate(-90)" text-anchor="middle">{escape(y_label)}</text>')
    return parts


def power(exponent):
    return {0: "1", 1: "10"}.get(exponent, f'10<tspan dy="-5" font-size="9">{str(exponent).replace("-", "−")}</tspan>')


def curve(line, colour, place, at):
    """A line with its points, and its entry in the legend."""
    dash = ' stroke-dasharray="5 4"' if line.dashed else ""
    places = [place(x, y) for x, y in sorted(line.points)]
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    parts = [f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>']
    parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in places]
    left = WIDTH - RIGHT + 16
    parts.append(f'<line x1="{left}" y1="{at}" x2="{left + 28}" y2="{at}" stroke="{colour}" stroke-width="2"{dash}/>')
    parts.append(f'<text x="{left + 36}" y="{at + 4}">{escape(line.label)}</text>')
    return parts
