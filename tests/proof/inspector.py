"""Commands of the inspector that the proof runs."""
import json
import os
import subprocess
import tempfile

import numpy as np

import jobs


class InspectorError(Exception):
    """Message of a command that failed."""


class Inspector:
    """Runs the program at a path."""

    def __init__(self, path):
        self.path = path
        # A cold driver spends most of the time on compiling shaders.
        self.environment = {**os.environ, "GALLIVM_PERF": "nopt"}
        self.commands = []

    def run(self, *words):
        """Runs a command and returns what it prints."""
        command = [self.path, *map(str, words)]
        self.commands.append(command[1:])
        done = subprocess.run(command, capture_output=True, text=True, env=self.environment)
        if done.returncode != 0:
            raise InspectorError(" ".join(command) + "\n" + done.stderr.strip())
        return done.stdout

    def picture(self, scene, size, *words):
        """Returns one number a pixel of a picture, top row first."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.pfm")
            self.run(*words[:1], scene, "--size", f"{size[0]}x{size[1]}", "-o", path, *words[1:])
            return jobs.read_pfm(path)

    def visibility(self, bundle, size, profile, parameters):
        """Returns the mask of the inspector's own map with a bundle's matrix, under a profile with the engine's numbers."""
        words = ["render", "--view", "visibility", "--profile", profile, "--set", "map.bundle_maps=drawn"]
        for key, value in parameters.items():
            words += ["--set", f"engine.{key}={number_text(value)}"]
        return self.picture(bundle, size, *words)

    def convert(self, profile, settings, clip_facts, angle_deg):
        """Returns the engine's numbers for settings of the inspector, by parameter."""
        with tempfile.TemporaryDirectory() as folder:
            preset = os.path.join(folder, "preset.json")
            with open(preset, "w") as file:
                json.dump({"format": "shadow-inspector-preset", "version": 3, "title": "proof",
                           "settings": {**settings, "light.extent": clip_facts["width_m"] / 2, "light.near": 1.0,
                                        "light.far": 1.0 + clip_facts["depth_m"], "light.fit": "manual",
                                        "map.resolution": clip_facts["texels"]}}, file)
            text = self.run("convert", preset, "--to", profile, "--no-scene", "--json", "--angle",
                            f"{min(angle_deg, 89):.9g}")
        made = json.loads(text)
        for key, wanted in (("width_m", clip_facts["width_m"]), ("depth_m", clip_facts["depth_m"])):
            if abs(made[key] - wanted) > 1e-6 * wanted:
                raise InspectorError(f"convert: {key} is {made[key]} in place of {wanted}")
        return {row["key"]: row for row in made["engine"]["parameters"]}


def number_text(value):
    return value if isinstance(value, str) else repr(float(value))


def map_facts(clip_from_world, texels):
    """Returns width and depth range of a parallel light's matrix, metres."""
    rows = np.asarray(clip_from_world)[:3, :3]
    return {"width_m": 2 / float(np.linalg.norm(rows[0])), "height_m": 2 / float(np.linalg.norm(rows[1])),
            "depth_m": 2 / float(np.linalg.norm(rows[2])), "texels": texels}
