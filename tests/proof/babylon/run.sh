#!/usr/bin/env bash
# Draws jobs in Babylon.js: run.sh JOB... writes mask.pgm and facts.json into each folder.
# Its shaders read maps by a sampler2D without precision. Mesa's OpenGL ES then reads 16-bit floats, and needs up to 2^-11
# of the depth range more bias. SwiftShader reads 32 bits, as drivers of desktops do.
export SI_PROOF_ANGLE=swiftshader
exec "$(dirname "${BASH_SOURCE[0]}")/../browser/run.sh" babylon "$@"
