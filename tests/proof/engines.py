"""Engines of the proof: where their programs are, and which of their parameters are proved.

kernel: parameters of the filter that is nearest to one hard comparison, and the settings from which it is converted.
plane: parameters with which a single plane casts on itself.
off: parameters of the bias with values that add none.
acne: parameters of the bias, each with the setting of the inspector from which its number is converted.
fits: True for an engine that chooses the light's box by itself, and reports it in facts.json.
"""

ENGINES = {
    "three": {
        "title": "three.js",
        "kernel": {"shadowMap.type": "BasicShadowMap"},
        "settings": {"filter.kernel": "hard"},
        "plane": {"shadowSide": "DoubleSide"},
        "off": {"bias": 0, "normalBias": 0},
        "acne": [("bias", "bias.constant"), ("normalBias", "bias.normal")],
        "fits": False,
    },
    "babylon": {
        "title": "Babylon.js",
        "kernel": {"filter": "NONE"},
        "settings": {"filter.kernel": "hard"},
        "plane": {},
        "off": {"bias": 0, "normalBias": 0},
        "acne": [("bias", "bias.constant"), ("normalBias", "bias.normal")],
        "fits": True,
    },
    "playcanvas": {
        "title": "PlayCanvas",
        "kernel": {"shadowType": "SHADOW_PCF1_32F"},
        "settings": {"filter.kernel": "hw2x2"},
        "plane": {},
        "off": {"shadowBias": 0, "normalOffsetBias": 0},
        "acne": [("shadowBias", "bias.constant"), ("normalOffsetBias", "bias.normal")],
        "fits": True,
    },
}
