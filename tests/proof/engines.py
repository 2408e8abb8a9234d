"""Engines of the proof, by the names of their profiles: their programs, and which of their parameters are proved.

folder: folder of the engine's program; without it that of the profile's name.
kernel: parameters of the filter that is nearest to one hard comparison, and the settings from which it is converted.
plane: parameters with which a single plane casts on itself.
off: parameters of the bias with values that add none.
acne: parameters of the bias, each with the setting of the inspector from which its number is converted.
filters: other filters, by name, under which the first parameter of acne is proved at 45 degrees.
resolution_factor: factor of the maps' width for an engine that fits a wide box of the light; without it 1.
reversed: True for an engine whose matrix stores reversed depth.
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
        "filters": {"PCFShadowMap": {"kernel": {"shadowMap.type": "PCFShadowMap"},
                                     "settings": {"filter.kernel": "vogel", "filter.taps": 5,
                                                  "filter.bilinear": True}}},
        "fits": False,
    },
    "babylon": {
        "title": "Babylon.js",
        "kernel": {"filter": "NONE"},
        "settings": {"filter.kernel": "hard"},
        "plane": {},
        "off": {"bias": 0, "normalBias": 0},
        "acne": [("bias", "bias.constant"), ("normalBias", "bias.normal")],
        "filters": {"PCF": {"kernel": {"filter": "PCF"},
                            "settings": {"filter.kernel": "castano5"}}},
        "about": "Babylon.js moves casters inwards by `normalBias`, where the program moves the look-up. So thin "
                 "casters lose width, and rods of two texels vanish. The maps here hold 32-bit floats (`new "
                 "ShadowGenerator(size, light, true)`). Babylon's default 16-bit floats round depths to 2^-11 of the"
                 " depth range, so acne begins at a larger bias. The engine's shaders read maps of the filters NONE,"
                 " POISSON and ESM by a `sampler2D` without a precision qualifier. A driver of OpenGL ES, such as "
                 "Mesa's, may then read 16 bits, with the same effect. These pictures are by Mesa's desktop OpenGL, which "
                 "reads 32 bits.",
        "fits": True,
    },
    "playcanvas": {
        "title": "PlayCanvas",
        "kernel": {"shadowType": "SHADOW_PCF1_32F"},
        "settings": {"filter.kernel": "hw2x2"},
        "plane": {},
        "off": {"shadowBias": 0, "normalOffsetBias": 0},
        "acne": [("shadowBias", "bias.constant"), ("normalOffsetBias", "bias.normal")],
        "filters": {"SHADOW_PCF3_32F": {"kernel": {"shadowType": "SHADOW_PCF3_32F"},
                                        "settings": {"filter.kernel": "tent3", "filter.bilinear": True}}},
        "fits": True,
    },
    "ogre": {
        "title": "OGRE",
        "kernel": {},
        "settings": {"filter.kernel": "pcf", "filter.size": 2, "map.format": "d16"},
        "plane": {"ShadowCasterRenderBackFaces": "false"},
        "off": {"depth_bias.constant": 0, "depth_bias.slope": 0},
        "acne": [("depth_bias.constant", "bias.constant"), ("depth_bias.slope", "bias.raster_slope")],
        "fits": False,
    },
    "filament19": {
        "title": "Filament",
        "folder": "filament",
        "reversed": True,
        "kernel": {"shadowType": "PCF"},
        "settings": {"filter.kernel": "tent3", "filter.bilinear": True, "map.format": "d16", "map.reversed_z": True},
        "plane": {},
        "off": {"constantBias": 0, "polygonOffsetSlope": 0, "polygonOffsetConstant": 0},
        "acne": [("constantBias", "bias.constant"), ("polygonOffsetSlope", "bias.raster_slope")],
        "fits": True,
    },
    "godot3": {
        "title": "Godot",
        "kernel": {"filter_mode": "Disabled"},
        "settings": {"filter.kernel": "hw2x2"},
        "plane": {},
        "resolution_factor": 2,
        "off": {"shadow_bias": 0, "directional_shadow_normal_bias": 0},
        "acne": [("shadow_bias", "bias.constant")],
        "fits": True,
    },
}
