// Materials of the stage, which the scenes of the hard cases have, too.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace si {

/// Opaque material of one colour for built-in scenes: its name and linear colour.
struct PlainMaterial {
    const char* name;
    glm::vec3 linear_colour;
};
inline constexpr PlainMaterial kPlaster{"Terracotta plaster", {0.56f, 0.25f, 0.15f}};
inline constexpr PlainMaterial kSlate{"Slate", {0.13f, 0.21f, 0.29f}};
inline constexpr PlainMaterial kPorcelain{"Porcelain", {0.74f, 0.71f, 0.64f}};
inline constexpr PlainMaterial kHeather{"Heather", {0.33f, 0.22f, 0.33f}};
inline constexpr PlainMaterial kBrass{"Brass", {0.58f, 0.40f, 0.13f}};

/// Side of the paving's texture on the ground, metres: four slabs.
inline constexpr float kPavingSide_m = 3.2f;

/// Adds an opaque material of one colour to a scene. Returns its index in Scene::materials.
int add_material(Scene& scene, const PlainMaterial& material);
/// Adds a material of limestone paving slabs to a scene, with its texture. Returns the material's index in
/// Scene::materials.
int add_paving(Scene& scene);

}  // namespace si
