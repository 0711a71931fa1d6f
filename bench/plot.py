#!/usr/bin/env python3
"""Draws error against time for papers, one figure a scene, from results.json: SVG and PNG.

Usage: bench/plot.py DIR/results.json [-o FOLDER] [--metric relMse|relMseTrimmed] [--variants NAME NAME ...]
Needs matplotlib (Debian: python3-matplotlib).
"""
import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

CURVES = {"relMse": ("curve", "relMSE"), "relMseTrimmed": ("trimmedCurve", "relMSE without the worst 0.1%")}


def draw_variant(axes, grid, variant, curve_key):
    points = [(x, *p) for x, p in zip(grid, variant[curve_key]) if p[0]]
    if not points:
        return
    seconds, middle, low, high = zip(*points)
    (line,) = axes.plot(seconds, middle, marker="o", markersize=3, label=variant["name"])
    if all(v is not None for v in low):
        axes.fill_between(seconds, low, high, color=line.get_color(), alpha=0.15, linewidth=0)


def draw_guide(axes):
    """The slope of an estimator that has nothing left to learn."""
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    axes.plot([x0, x1], [y1, y1 * x0 / x1], linestyle="--", color="gray", linewidth=1, label="slope -1")
    axes.set_xlim(x0, x1)
    axes.set_ylim(y0, y1)


def draw_scene(scene, metric, names, folder):
    curve_key, label = CURVES[metric]
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    axes.set_xscale("log")
    axes.set_yscale("log")
    for variant in scene["variants"]:
        if not names or variant["name"] in names:
            draw_variant(axes, scene["grid"], variant, curve_key)
    for point in scene["imports"]:
        axes.plot(point["point"]["seconds"], point["point"][metric], "k*", label=point["name"])
    draw_guide(axes)
    axes.set(title=scene["name"], xlabel="seconds, training included", ylabel=label)
    axes.grid(True, which="major", linewidth=0.5)
    axes.legend(fontsize=7)
    for ending in ("svg", "png"):
        file = folder / f"{scene['name']}.{metric}.{ending}"
        figure.savefig(file, dpi=160)
        print(file)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path, help="results.json of a run")
    parser.add_argument("-o", "--out", type=pathlib.Path, help="folder for the figures (default: beside the results)")
    parser.add_argument("--metric", choices=CURVES, default="relMse")
    parser.add_argument("--variants", nargs="+", default=[], help="names (default: all)")
    arguments = parser.parse_args()
    folder = arguments.out or arguments.results.parent / "plots"
    folder.mkdir(parents=True, exist_ok=True)
    names = set(arguments.variants)
    for scene in json.loads(arguments.results.read_text())["scenes"]:
        if any(v["cells"] for v in scene["variants"]):
            draw_scene(scene, arguments.metric, names, folder)


if __name__ == "__main__":
    main()
