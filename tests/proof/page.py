#!/usr/bin/env python3
"""Writes docs/engines.md and its pictures from results of prove.py: page.py RESULTS_FOLDER PAGE.md."""
import json
import os
import sys

import criteria
import pictures
from engines import ENGINES

HEAD = """# Proof in real engines

This page compares shadows of real engines with those of the program, under the engine's [profile](profiles.md).
`scripts/prove_engines.sh` draws, compares and writes it.

Each engine draws {scenes} scenes and {planes} tilted planes with its own shadow maps, from numbers that `convert` gives. The program draws them with the same numbers (`--profile NAME --set engine.PARAMETER=VALUE`) and the same orthographic view volume of the light. Both write a mask (a picture of light and shadow). The two masks are compared.

| criterion | bound |
|---|---|
| interior: compared pixels farther than {interior_texels} texels and {interior_pixels} pixels from every edge of the ray-traced mask | at least {min_interior:.0f} % |
| equal: interior pixels whose visibility differs by at most {max_difference:g} | at least {min_equal:.1f} % |
| edges: distance between both edges on the map | at most {max_edge:g} texels, on at least {min_near:.1f} % of the pixels around edges |
| acne begins: smallest number on a grid of 5 % at which fewer than 0.1 % of a plane's pixels are dark | within 10 % |

A pixel of a tilted plane is dark where its visibility is below {dark:g}. Pixels without a surface, and those with N·L (surface normal and light) below {min_n_dot_l:g}, are left out when the masks of engine and program are compared. An edge that differs by one pixel counts as equal.
In the scenes, the engine's numbers are converted from a constant bias of {constant:g} texels and a normal offset of {normal:g} texel. Alpha masks of materials are left out, so that leaves are whole rectangles.
"""

LEGEND = ("Each row shows the mask of the engine, the mask of the program, and their difference. A red pixel is in "
          "shadow in the engine's mask alone, a blue one in the program's alone. Pale blue pixels are not compared. In "
          "the difference, pixels near an edge of the ray-traced mask are darker than all others.")


def percent(share, digits=2):
    return f"{100 * share:.{digits}f} %"


def met(passed):
    return "yes" if passed else "**no**"


def number(value):
    return "none found" if value is None else f"{value:.4g}"


def scene_rows(result):
    for s in result["scenes"]:
        furthest = "beyond the window" if s["edge_max_texels"] is None else f"{s['edge_max_texels']:.2f} texels"
        yield (f"| {s['title']} | {s['texels']} | {1000 * s['width_m'] / s['texels']:.1f} mm | "
               f"{percent(s['interior_share'], 1)} | {percent(s['equal_share'], 3)} | "
               f"{s['edge_differ_px']} of {s['edge_px']} | {s['edge_beyond_px']}, {furthest} | "
               f"{met(all(s['passed'].values()))} |")


def acne_rows(result):
    for a in result["acne"]:
        ratio = "" if a["ratio"] is None else f"{a['ratio']:.3f}"
        under = f" under `{a['filter']}`" if a["filter"] else ""
        yield (f"| `{a['parameter']}`{under} | {a['tilt_deg']:g}° | {'diagonal' if a['diagonal'] else 'axis'} | "
               f"{number(a['base'])} | {number(a['ours'])} | {number(a['theirs'])} | {ratio} | {met(a['passed'])} |")


def section(result, folder_name):
    lines = [f"## {result['title']} {result['version']}", ""]
    about = ENGINES[result["engine"]].get("about")
    if about:
        lines += [about, ""]
    lines += ["| scene | map | texel | interior | equal | edge pixels that differ | beyond 1.5 texels, farthest | met |",
              "|---|--:|--:|--:|--:|--:|--:|---|", *scene_rows(result), "",
              "| parameter | tilt | along | converted | acne begins here | acne begins in the engine | ratio | met |",
              "|---|--:|---|--:|--:|--:|--:|---|", *acne_rows(result), "",
              LEGEND, ""]
    for s in result["scenes"]:
        lines += [f"![{result['title']}, {s['title']}: masks of the engine and the program, and their "
                  f"difference]({folder_name}/{result['engine']}-{s['scene']}.png)", ""]
    return lines


def halve(path, to):
    import numpy as np
    with np.load(path) as masks:
        row = [pictures.grey(masks["theirs"], masks["compared"]), pictures.grey(masks["ours"], masks["compared"]),
               pictures.difference(masks["theirs"], masks["ours"], masks["compared"], masks["interior"])]
    pictures.write_png(to, pictures.side_by_side([pictures.halved(p) for p in row]))


def main():
    results, page = sys.argv[1:3]
    found = []
    for name in ENGINES:
        path = os.path.join(results, name, "result.json")
        if os.path.exists(path):
            with open(path) as file:
                found.append(json.load(file))
    from prove import CONSTANT_TEXELS, MIN_N_DOT_L, NORMAL_TEXELS, TILTS_DEG
    lines = [HEAD.format(scenes=len(found[0]["scenes"]), planes=2 * len(TILTS_DEG),
                         interior_texels=criteria.INTERIOR_TEXELS, interior_pixels=criteria.INTERIOR_PIXELS,
                         min_interior=100 * criteria.MIN_INTERIOR_SHARE, max_difference=criteria.MAX_DIFFERENCE, dark=criteria.DARK,
                         min_equal=100 * criteria.MIN_EQUAL_SHARE, max_edge=criteria.MAX_EDGE_TEXELS, min_near=100 * criteria.MIN_NEAR_SHARE,
                         min_n_dot_l=MIN_N_DOT_L, constant=CONSTANT_TEXELS, normal=NORMAL_TEXELS).rstrip(), "",
             "| engine | version | scenes that meet all | planes that meet the bound | largest deviation |",
             "|---|---|--:|--:|--:|"]
    for r in found:
        ratios = [max(a["ratio"], 1 / a["ratio"]) for a in r["acne"] if a["ratio"]]
        lines.append(f"| [{r['title']}](#{r['title'].lower().replace('.', '').replace(' ', '-')}-"
                     f"{r['version'].replace('.', '').lower()}) | {r['version']} | "
                     f"{sum(all(s['passed'].values()) for s in r['scenes'])} of {len(r['scenes'])} | "
                     f"{sum(a['passed'] for a in r['acne'])} of {len(r['acne'])} | "
                     f"{percent(max(ratios) - 1, 1) if ratios else ''} |")
    lines.append("")
    folder_name = os.path.join("images", "engines")
    folder = os.path.join(os.path.dirname(page), folder_name)
    os.makedirs(folder, exist_ok=True)
    for r in found:
        lines += section(r, folder_name)
        for s in r["scenes"]:
            halve(os.path.join(results, r["engine"], f"{s['scene']}.npz"),
                  os.path.join(folder, f"{r['engine']}-{s['scene']}.png"))
    with open(page, "w") as file:
        file.write("\n".join(lines).rstrip() + "\n")


if __name__ == "__main__":
    main()
