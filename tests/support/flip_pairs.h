// Pairs of pictures with their LDR-FLIP values, from a table VALUES.tsv.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"

namespace si::test {

/// Two picture files and their difference, computed by another program.
struct FlipPair {
    std::filesystem::path a, b;
    double pixels_per_degree = 0, mean = 0, max = 0;
};

/// Returns the pairs of tests/data/flip, made by tests/tools/make_flip_pictures.py.
std::vector<FlipPair> committed_flip_pairs();
/// Returns the pairs of ../shared/flip with the values of the authors' program; empty where that folder is missing.
std::vector<FlipPair> shared_flip_pairs();

/// Reads a picture file. Fails the running test if the file cannot be read.
ByteImage picture_in(const std::filesystem::path& file);

}  // namespace si::test
