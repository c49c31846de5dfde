"""Bars of the detection rates as SVG: defaults and tuned, lowest to highest seed as a line, the paper's as a mark."""

import statistics

from . import plan as plans
from . import tables

PAPER_RATES = {"esi": 81.39, "accumulator": 46.31, "complementary": 43.44, "edi": 14.52}
ROW, BAR, TOP, LEFT, SCALE = 40, 13, 50, 150, 5  # px; SCALE px per per cent
DEFAULT, TUNED = "#9ab", "#247"


def write(run, path):
    scores = tables.scoring(run)
    parts = []
    for i, method in enumerate(plans.METHODS):
        y = TOP + i * ROW
        parts.append(f'<text x="{LEFT - 8}" y="{y + 17}" text-anchor="end">{method}</text>')
        for label, colour, top in ((method, DEFAULT, y), (method + "-tuned", TUNED, y + BAR)):
            parts += bar([100 * rate for rate in scores.rates(label)], colour, top)
        if method in PAPER_RATES:
            x = LEFT + SCALE * PAPER_RATES[method]
            parts.append(f'<path d="M{x:.1f} {y - 3}v{2 * BAR + 6}" stroke="#c30" stroke-width="3"/>')
    width, height = LEFT + 100 * SCALE + 40, TOP + ROW * len(plans.METHODS)
    legend = "Light: authors' defaults; dark: tuned; black line: lowest to highest seed; red: the paper"
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
        f'font-size="13">\n<rect width="{width}" height="{height}" fill="white"/>\n'
        f'<text x="8" y="18">Frames with the board detected, %</text>\n<text x="8" y="36">{legend}</text>\n' + "\n".join(parts) + "\n</svg>\n",
        encoding="utf-8")


def bar(rates, colour, top):
    if not rates:
        return []
    mean, middle = statistics.mean(rates), top + BAR / 2
    low, high = (LEFT + SCALE * value for value in (min(rates), max(rates)))
    return [f'<rect x="{LEFT}" y="{top}" width="{SCALE * mean:.1f}" height="{BAR - 1}" fill="{colour}"/>',
            f'<path d="M{low:.1f} {middle}H{high:.1f}" stroke="black" stroke-width="2"/>',
            f'<text x="{max(high, LEFT + SCALE * mean) + 4:.1f}" y="{top + 11}" font-size="11">{mean:.1f}</text>']
