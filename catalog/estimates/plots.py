"""A plot of each law as SVG: what a source says against what the law says of a series left out."""
import math
import pathlib

SIZE, LEFT, BOTTOM, TOP = 320, 56, 44, 30


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def decades(low, high):
    return [10.0 ** k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)]


def plot(named):
    """Both axes logarithmic and alike; the band is one standard deviation."""
    law = named.law
    pairs = [(p.y, law.left_out.get(id(p), law.predict(p.x)), p) for p in law.points]
    low = min(min(a, b) for a, b, _ in pairs) / 1.5
    high = max(max(a, b) for a, b, _ in pairs) * 1.5
    span = math.log(high / low)

    def place(value):
        return (SIZE - LEFT - 12) * math.log(value / low) / span

    def at(x, y):
        return f"{LEFT + place(x):.1f},{SIZE - BOTTOM - place(y) * SCALE:.1f}"

    SCALE = (SIZE - BOTTOM - TOP) / (SIZE - LEFT - 12)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIZE}" height="{SIZE}" '
             f'font-family="sans-serif" font-size="11" fill="#222">',
             f'<rect width="{SIZE}" height="{SIZE}" fill="#fff"/>',
             f'<text x="{LEFT}" y="16" font-size="12">{escape(named.title)}</text>']
    for shift, style in ((0.0, 'stroke="#444"'), (law.sigma, 'stroke="#aaa" stroke-dasharray="4 3"'),
                         (-law.sigma, 'stroke="#aaa" stroke-dasharray="4 3"')):
        a, b = low * math.exp(max(0.0, -shift)), high * math.exp(min(0.0, -shift))
        lines.append(f'<polyline points="{at(a, a * math.exp(shift))} {at(b, b * math.exp(shift))}" '
                     f'fill="none" {style}/>')
    for value in decades(low, high):
        if low <= value <= high:
            x, y = at(value, value).split(",")
            lines.append(f'<text x="{x}" y="{SIZE - BOTTOM + 15}" text-anchor="middle">{value:g}</text>')
            lines.append(f'<text x="{LEFT - 6}" y="{y}" text-anchor="end">{value:g}</text>')
    for known, predicted, point in pairs:
        x, y = at(known, predicted).split(",")
        lines.append(f'<circle cx="{x}" cy="{y}" r="3" fill="#1f6feb" fill-opacity="0.6">'
                     f'<title>{escape(point.part)}: {known:.3g}, law {predicted:.3g}</title></circle>')
    lines.append(f'<text x="{SIZE / 2}" y="{SIZE - 8}" text-anchor="middle">'
                 f'by a source, {escape(named.unit)}</text>')
    lines.append(f'<text x="12" y="{SIZE / 2}" text-anchor="middle" '
                 f'transform="rotate(-90 12 {SIZE / 2})">by the law, series left out</text>')
    return "\n".join(lines + ["</svg>", ""])


def report(folder, made, spreads, pumped):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    print("| what | law | parts | series | error |\n| --- | --- | --- | --- | --- |")
    for key, named in made.items():
        (folder / f"{key}.svg").write_text(plot(named), encoding="utf-8")
        print(f"| {named.title} | {named.formula} | {len(named.law.points)} | {named.law.series} "
              f"| {100 * named.law.sigma:.0f} % |")
    (ratio, way), (efficiency, line) = spreads, pumped
    print(f"| b of a valve | {ratio[0]:.2f} where it is printed; 0.3 is used | | "
          f"| {100 * ratio[1]:.0f} % |")
    print(f"| C out over C in of a valve | {way[0]:.2f} where both are printed; 1 is used | | "
          f"| {100 * way[1]:.0f} % |")
    print(f"| best isothermal efficiency of a pump | {efficiency[0]:.2f} | | "
          f"| {100 * efficiency[1]:.0f} % |")
    print(f"| flow of a pump, straight between its ends | 1 | | | {100 * line:.0f} % |")


def report_rules(missed, kept):
    """How far the rules miss, and where no row says it."""
    print("\n| what | series | error |\n| --- | --- | --- |")
    for spread in missed:
        error = f"{100 * min(spread.sigma, 1.0):.0f} %" if spread.sigma else "keeps the default"
        print(f"| {spread.title} | {len(spread.errors)} | {error} |")
    print("\n| family | number | estimates that keep the default |\n| --- | --- | --- |")
    for (family, field), count in sorted(kept.items()):
        print(f"| {family} | `{field}` | {count} |")
