// Tests of shadow_bundle.h, the writer of bundles that other engines include: files are read again and compared with
// the values that were given.
#include "assets/bundle/shadow_bundle.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <bit>
#include <cmath>
#include <csignal>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "renderer/gltf/image_decode.h"
#include "tests/support/process.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using test::Json;
using test::TemporaryFolder;

constexpr std::array<float, 12> kQuad = {-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1};
constexpr std::array<std::uint16_t, 6> kTriangles = {0, 2, 1, 0, 3, 2};
constexpr std::array<double, 16> kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

sb_mesh_data quad() {
    sb_mesh_data mesh{};
    mesh.positions = kQuad.data();
    mesh.vertex_count = 4;
    mesh.indices16 = kTriangles.data();
    mesh.index_count = 6;
    return mesh;
}

sb_image_data image_of(const void* texels, sb_texel type, int width, int height) {
    sb_image_data image{};
    image.texels = texels;
    image.type = type;
    image.width = width;
    image.height = height;
    return image;
}

/// Bundle in a temporary folder, with shorthands for what most tests have.
struct Writer {
    TemporaryFolder folder;
    fs::path path = folder.path() / "frame.bundle";
    shadow_bundle* sb = sb_begin(path.c_str(), "a test");

    int place(const char* name, unsigned flags = SB_CASTS | SB_RECEIVES, sb_matrix world = identity()) {
        const sb_mesh_data mesh = quad();
        return sb_instance(sb, sb_mesh(sb, &mesh), world, name, flags);
    }
    int depth_image(int width = 2, int height = 2) {
        const std::vector<float> depths(std::size_t(width) * std::size_t(height), 0.5f);
        const sb_image_data image = image_of(depths.data(), SB_F32, width, height);
        return sb_image(sb, &image);
    }
    /// Adds a light with one map and returns the map.
    int add_map(sb_matrix clip = identity()) {
        return sb_map(sb, sb_light(sb, "sun", SB_DIRECTIONAL), depth_image(), clip, SB_RANGE_0_TO_1, 0);
    }
    static sb_matrix identity() { return sb_columns_d(kIdentity.data()); }
    /// Ends the bundle and returns its error.
    std::string end() {
        std::array<char, 512> message{};
        const sb_code code = sb_end(sb, message.data(), message.size());
        sb = nullptr;
        EXPECT_EQ(code == SB_OK, message[0] == '\0');
        return message.data();
    }
    bool is_whole() const { return fs::exists(path / "frame.json"); }
    Json frame() const { return Json::parse(file_bytes(path / "frame.json")); }
    ~Writer() { sb_cancel(sb); }
    Writer() = default;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
};

TEST(ShadowBundle, AllThatIsStatedIsWritten) {
    Writer w;
    const std::array<double, 3> origin = {1000, 0, -2000.5};
    sb_world(w.sb, SB_UP_Z, SB_LEFT_HANDED, 0.01, origin.data());
    const int tree = w.place("Tree"), house = w.place("House", SB_RECEIVES), fence = w.place("Fence", SB_CASTS);
    EXPECT_EQ(std::vector({tree, house, fence}), (std::vector{0, 1, 2}));
    sb_matrix clip = Writer::identity();
    clip.m[12] = 0.25;
    sb_camera(w.sb, clip, 1280, 720, SB_RANGE_MINUS_1_TO_1, 1);
    const std::array<std::uint8_t, 16> pixels = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 8, 7, 255};
    sb_picture(w.sb, pixels.data(), 2, 2, 0, SB_FIRST_ROW_BOTTOM);
    sb_note(w.sb, "A remark.");
    sb_note(w.sb, "Another one.");

    const int sun = sb_light(w.sb, "sun", SB_DIRECTIONAL);
    sb_light_direction(w.sb, sun, -0.5, -1, -0.35);
    sb_light_choice(w.sb, sun, SB_CHOICE_INTERVAL);
    sb_lookup_bias(w.sb, sun, SB_BIAS_CONSTANT, 0.0005, SB_UNIT_DEPTH);
    sb_lookup_bias(w.sb, sun, SB_BIAS_SLOPE, 1.5, SB_UNIT_TEXELS);
    sb_lookup_bias(w.sb, sun, SB_BIAS_NORMAL, 0.02, SB_UNIT_METRES);
    sb_lookup_kernel(w.sb, sun, "pcf3");
    sb_lookup_compare(w.sb, sun, SB_LESS_EQUAL);
    sb_lookup_sampler(w.sb, sun, SB_LINEAR, SB_CLAMP);
    sb_lookup_shader(w.sb, sun, "float shadow() {\n  return 1.0;\n}\n");
    const int atlas = w.depth_image(4, 2);
    for (const int x : {0, 2}) {
        const int map = sb_map(w.sb, sun, atlas, clip, SB_RANGE_0_TO_1, 0);
        sb_map_region(w.sb, map, x, 0, 2, 2);
        sb_map_interval(w.sb, map, 0.1 + x, 2.5 + x);
        const std::array<int, 2> drawn = {tree, fence};
        sb_map_drawn(w.sb, map, drawn.data(), x == 0 ? 2 : 0);
        sb_map_format(w.sb, map, SB_D16);
        sb_map_clear(w.sb, map, 1);
        sb_map_offset(w.sb, map, 2, 4, 0.125);
        sb_map_caster_shift(w.sb, map, 0.13, 0.1);
        sb_map_cull(w.sb, map, SB_CULL_FRONT, SB_FRONT_CW);
        sb_map_depth_clamp(w.sb, map, 1);
    }
    const int lamp = sb_light(w.sb, nullptr, SB_SPOT);
    sb_light_position(w.sb, lamp, 1, 2, 3);
    sb_light_cone(w.sb, lamp, 75.5);
    const int map = sb_map(w.sb, lamp, w.depth_image(), clip, SB_RANGE_MINUS_1_TO_1, 1);
    sb_map_stored(w.sb, map, SB_STORED_DISTANCE_SHARE, 12.5);
    ASSERT_EQ(w.end(), "");

    const Json matrix = clip.m;
    const auto map_json = [&](int x, const Json& drawn) {
        return Json{
            {"image", {{"file", "map0.pfm"}, {"first_row", "bottom"}}},
            {"region", {x, 0, 2, 2}},
            {"clip_from_world", matrix},
            {"depth", {{"range", "0..1"}, {"reversed", false}, {"stored", "depth"}, {"format", "d16"}, {"clear", 1}}},
            {"raster",
             {{"offset_factor", 2},
              {"offset_units", 4},
              {"offset_clamp", 0.125},
              {"shift_m", 0.13},
              {"grazing_shift_m", 0.1},
              {"cull", "front"},
              {"front", "cw"},
              {"depth_clamp", true}}},
            {"interval", {0.1 + x, 2.5 + x}},
            {"drawn", drawn}};
    };
    const Json expected = {
        {"bundle", 1},
        {"made_by", "a test"},
        {"scene", "scene.glb"},
        {"world", {{"up", "z"}, {"hand", "left"}, {"metres_per_unit", 0.01}, {"origin", origin}}},
        {"camera",
         {{"clip_from_world", matrix},
          {"width", 1280},
          {"height", 720},
          {"depth", {{"range", "-1..1"}, {"reversed", true}}}}},
        {"picture", "picture.png"},
        {"lights",
         {{{"name", "sun"},
           {"type", "directional"},
           {"direction", {-0.5, -1, -0.35}},
           {"choice", "interval"},
           {"maps", {map_json(0, {"Tree", "Fence"}), map_json(2, Json::array())}},
           {"lookup",
            {{"bias", {{"constant", 0.0005}, {"slope", 1.5}, {"normal", 0.02}, {"units", "depth, texels, metres"}}},
             {"kernel", "pcf3"},
             {"compare", "less-equal"},
             {"filter", "linear"},
             {"wrap", "clamp"},
             {"shader", "lookup0.txt"}}}},
          {{"name", ""},
           {"type", "spot"},
           {"position", {1, 2, 3}},
           {"cone_deg", 75.5},
           {"maps",
            Json::array(
                {{{"image", {{"file", "map1.pfm"}, {"first_row", "bottom"}}},
                  {"clip_from_world", matrix},
                  {"depth",
                   {{"range", "-1..1"}, {"reversed", true}, {"stored", "distance-share"}, {"range_m", 12.5}}}}})},
           {"lookup", Json::object()}}}},
        {"notes", {"A remark.", "Another one."}}};
    EXPECT_EQ(w.frame(), expected) << Json::diff(w.frame(), expected).dump(1);
    EXPECT_EQ(file_bytes(w.path / "lookup0.txt"), "float shadow() {\n  return 1.0;\n}\n");
    const std::string png = file_bytes(w.path / "picture.png");
    const gltf::Image picture = gltf::decode_image({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()});
    EXPECT_EQ(picture.error, "");
    EXPECT_EQ(picture.rgba, (std::vector<std::uint8_t>{0, 0, 255, 255, 9, 8, 7, 255, 255, 0, 0, 255, 0, 255, 0, 255}));
    const Scene scene = load_gltf(w.path / "scene.glb");
    EXPECT_EQ(scene.suggested, (std::vector<std::pair<std::string, std::string>>{{"object.Fence.receive", "false"},
                                                                                 {"object.House.cast", "false"}}));
}

// A missing member is unknown and never 0.
TEST(ShadowBundle, NothingIsWrittenThatWasNotStated) {
    Writer w;
    w.add_map();
    ASSERT_EQ(w.end(), "");
    const Json frame = w.frame();
    EXPECT_EQ(frame.size(), 3u) << frame;
    EXPECT_EQ(frame["lights"][0].size(), 4u) << frame;
    EXPECT_EQ(frame["lights"][0]["lookup"], Json::object());
    EXPECT_EQ(frame["lights"][0]["maps"][0].size(), 3u) << frame;
    EXPECT_FALSE(fs::exists(w.path / "scene.glb"));
}

TEST(ShadowBundle, MeshesLoadAsTheyWere) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-3, 3);
    struct Vertex {
        float position[3], normal[3], uv[2], padding;
    };
    // More vertices than 16 bits count, interleaved.
    std::vector<Vertex> vertices(70002);
    for (Vertex& v : vertices) v = {{any(random), any(random), any(random)}, {0, 1, 0}, {any(random), any(random)}, 0};
    std::vector<std::uint32_t> indices(vertices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = std::uint32_t(indices.size() - 1 - i);
    std::vector<std::uint8_t> mask(3 * 2 * 4 + 8);
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = std::uint8_t(i * 9);
    Writer w;
    sb_mesh_data mesh{};
    mesh.name = "cloud";
    mesh.positions = vertices[0].position;
    mesh.normals = vertices[0].normal;
    mesh.uv = vertices[0].uv;
    mesh.position_stride = mesh.normal_stride = mesh.uv_stride = sizeof(Vertex);
    mesh.vertex_count = vertices.size();
    mesh.indices32 = indices.data();
    mesh.index_count = indices.size();
    mesh.mask_rgba = mask.data();
    mesh.mask_width = 3;
    mesh.mask_height = 2;
    mesh.mask_row_bytes = 16;
    mesh.mask_cutoff = 0.25f;
    mesh.mask_clamp = 1;
    mesh.two_sided = 1;
    std::array<float, 16> world{};
    for (int i = 0; i < 16; ++i) world[std::size_t(i)] = i % 4 == 3 ? float(i == 15) : any(random);
    sb_instance(w.sb, sb_mesh(w.sb, &mesh), sb_columns_f(world.data()), "Cloud", SB_CASTS);
    w.place("Quad");
    w.add_map();
    ASSERT_EQ(w.end(), "");

    const Scene scene = load_gltf(w.path / "scene.glb");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    ASSERT_EQ(scene.meshes.size(), 2u);
    const Mesh& cloud = scene.meshes[0];
    ASSERT_EQ(cloud.positions.size(), vertices.size());
    for (std::size_t i = 0; i < vertices.size(); i += 997) {
        EXPECT_EQ(cloud.positions[i], glm::make_vec3(vertices[i].position));
        EXPECT_EQ(cloud.uv[i], glm::make_vec2(vertices[i].uv));
        EXPECT_EQ(cloud.indices[i], indices[i]);
    }
    EXPECT_EQ(glm::mat4(scene.nodes[0].world), glm::make_mat4(world.data()));
    const Material& material = scene.materials[std::size_t(cloud.material)];
    EXPECT_EQ(material.alpha, AlphaMode::Mask);
    EXPECT_EQ(material.alpha_cutoff, 0.25f);
    EXPECT_TRUE(material.double_sided);
    const Texture& texture = scene.textures[std::size_t(material.base_colour_texture)];
    EXPECT_EQ(texture.wrap_s, TextureWrap::Clamp);
    ASSERT_EQ(texture.rgba.size(), 24u);
    for (std::size_t y = 0; y < 2; ++y)
        for (std::size_t x = 0; x < 12; ++x) EXPECT_EQ(texture.rgba[y * 12 + x], mask[y * 16 + x]);
    ASSERT_EQ(scene.meshes[1].indices.size(), 6u);
    // The loader gives flat triangles vertices of their own.
    const Mesh& flat = scene.meshes[1];
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(flat.positions[flat.indices[i]], glm::make_vec3(&kQuad[3 * kTriangles[i]])) << i;
}

TEST(ShadowBundle, NumbersReadBackAsTheSame) {
    std::mt19937_64 random(11);
    const auto any = [&](bool as_float) {
        for (;;) {
            const double value = std::bit_cast<double>(random());
            const double out = as_float ? double(std::bit_cast<float>(std::uint32_t(random()))) : value;
            if (std::isfinite(out)) return out;
        }
    };
    for (int round = 0; round < 40; ++round) {
        Writer w;
        sb_matrix clip;
        for (double& value : clip.m) value = any(round % 2 == 0);
        clip.m[0] = 1e-310;
        clip.m[1] = 1e22;
        w.add_map(clip);
        ASSERT_EQ(w.end(), "");
        const Json read = w.frame()["lights"][0]["maps"][0]["clip_from_world"];
        for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(read[i].get<double>(), clip.m[i]) << i;
    }
}

TEST(ShadowBundle, MatricesAreReadByColumnsOrRows) {
    std::array<float, 16> m{};
    for (std::size_t i = 0; i < 16; ++i) m[i] = float(i);
    const sb_matrix columns = sb_columns_f(m.data()), rows = sb_rows_f(m.data());
    EXPECT_EQ(columns.m[13], 13);
    EXPECT_EQ(rows.m[13], 7) << "row 1, column 3";
    const glm::mat4 a = glm::make_mat4(m.data()), b = glm::transpose(a);
    const glm::mat4 expected = a * b;
    const sb_matrix product = sb_multiply(columns, rows);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(product.m[i], expected[i / 4][i % 4]);
}

TEST(ShadowBundle, TextStaysText) {
    Writer w;
    const std::vector<const char*> names = {
        "Tree", "Tree", "A/B", "say \"x\" \\ \n\t\x01", "bad \xff\xc3 bytes", "\u00e9\u4e2d", nullptr, "Tree #2", ""};
    std::vector<int> instances;
    for (const char* name : names) instances.push_back(w.place(name));
    w.place(std::string(5000, 'n').c_str());
    const int map = w.add_map();
    sb_map_drawn(w.sb, map, instances.data(), instances.size());
    sb_note(w.sb, "line\nof \"text\" \x1b[31m \xf0\x9f\x98\x80 \xed\xa0\x80");
    sb_lookup_kernel(w.sb, 0, "\"}],[{");
    ASSERT_EQ(w.end(), "");
    const Json frame = w.frame();
    EXPECT_EQ(frame["notes"][0], "line\nof \"text\" \x1b[31m \xf0\x9f\x98\x80 ???");
    EXPECT_EQ(frame["lights"][0]["lookup"]["kernel"], "\"}],[{");
    const Scene scene = load_gltf(w.path / "scene.glb");
    const Json drawn = frame["lights"][0]["maps"][0]["drawn"];
    ASSERT_EQ(drawn.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(drawn[i], scene.nodes[i].path) << i;
    EXPECT_EQ(drawn[2], "A_B");
    EXPECT_EQ(drawn[5], "\u00e9\u4e2d");
}

TEST(ShadowBundle, TexelsKeepTheirBits) {
    const std::array<std::uint16_t, 8> halves = {0, 1, 0xffff, 0x1234, 5, 6, 7, 8};
    const std::array<std::uint32_t, 8> words = {0, 1, 0xffffffff, 0x12345678, 5, 6, 7, 0x3f800000};
    struct Case {
        sb_texel type;
        const void* texels;
        int channels, channel;
        std::size_t row_bytes;
        const char* format;
        const char* depth;
    };
    const std::vector<Case> cases = {
        {SB_U16, halves.data(), 1, 0, 8, "u16", "d16"},    {SB_F16, halves.data(), 2, 1, 0, "f16", "r16f"},
        {SB_U24, words.data(), 1, 0, 16, "u24", "d24"},    {SB_U24_HIGH, words.data(), 1, 0, 0, "u24", "d24"},
        {SB_U32, words.data(), 1, 0, 0, "u32", nullptr},   {SB_F32, words.data(), 2, 0, 0, "f32", nullptr},
        {SB_F32, words.data(), 1, 0, 12, nullptr, nullptr}};
    Writer w;
    const int light = sb_light(w.sb, "sun", SB_DIRECTIONAL);
    for (const Case& c : cases) {
        sb_image_data image = image_of(c.texels, c.type, 2, 2);
        image.channels = c.channels;
        image.channel = c.channel;
        image.row_bytes = c.row_bytes;
        image.first_row = SB_FIRST_ROW_TOP;
        sb_map(w.sb, light, sb_image(w.sb, &image), Writer::identity(), SB_RANGE_0_TO_1, 0);
    }
    ASSERT_EQ(w.end(), "");
    const Json maps = w.frame()["lights"][0]["maps"];
    for (std::size_t i = 0; i < cases.size(); ++i) {
        SCOPED_TRACE(i);
        const Case& c = cases[i];
        const Json image = maps[i]["image"];
        EXPECT_EQ(image["first_row"], "top");
        EXPECT_EQ(image.value("format", ""), c.format ? c.format : "");
        EXPECT_EQ(maps[i]["depth"].value("format", ""), c.depth ? c.depth : "");
        EXPECT_EQ(image.value("channels", 1), c.channels);
        EXPECT_EQ(image.value("channel", 0), c.channel);
        const std::string bytes = file_bytes(w.path / image["file"].get<std::string>());
        std::string expected = c.format ? "" : "Pf\n2 2\n-1.0\n";
        const std::size_t size = c.type == SB_U16 || c.type == SB_F16 ? 2 : 4,
                          line = 2 * size * std::size_t(c.channels);
        for (std::size_t y = 0; y < 2; ++y) {
            std::string row(static_cast<const char*>(c.texels) + y * (c.row_bytes ? c.row_bytes : line), line);
            for (std::size_t x = 0; x < row.size() && c.type == SB_U24; x += 4) row[x + 3] = 0;
            if (c.type == SB_U24_HIGH)
                for (std::size_t x = 0; x < row.size(); x += 4) row = row.erase(x, 1).insert(x + 3, 1, '\0');
            expected += row;
        }
        EXPECT_EQ(bytes, expected);
        if (c.format) {
            EXPECT_EQ(image["width"], 2);
            EXPECT_EQ(image["height"], 2);
        }
    }
}

TEST(ShadowBundle, BadInputIsRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto with = [](int place, double value) {
        sb_matrix m = Writer::identity();
        m.m[place] = value;
        return m;
    };
    struct Case {
        const char* error;
        std::function<void(Writer&)> spoil;
    };
    const std::vector<Case> cases = {
        {"there is no light", [](Writer&) {}},
        {"light 0 has no map", [](Writer& w) { sb_light(w.sb, "sun", SB_DIRECTIONAL); }},
        {"number 5 is not finite", [&](Writer& w) { w.add_map(with(5, double(nan))); }},
        {"number 5 is not finite", [&](Writer& w) { sb_camera(w.sb, with(5, HUGE_VAL), 1, 1, SB_RANGE_0_TO_1, 0); }},
        {"the matrix is 0", [](Writer& w) { w.add_map(sb_matrix{}); }},
        {"last row of a world matrix", [&](Writer& w) { w.place("x", SB_CASTS, with(3, 2)); }},
        {"number 12 is not finite", [&](Writer& w) { w.place("x", SB_CASTS, with(12, double(nan))); }},
        {"there is no mesh 3", [](Writer& w) { sb_instance(w.sb, 3, Writer::identity(), "x", 0); }},
        {"index 4 is 9, the mesh has 4 vertices",
         [](Writer& w) {
             sb_mesh_data mesh = quad();
             const std::array<std::uint32_t, 6> wrong = {0, 1, 2, 0, 9, 3};
             mesh.indices16 = nullptr;
             mesh.indices32 = wrong.data();
             sb_mesh(w.sb, &mesh);
         }},
        {"no list of triangles",
         [](Writer& w) {
             sb_mesh_data mesh = quad();
             mesh.index_count = 4;
             sb_mesh(w.sb, &mesh);
         }},
        {"without indices",
         [](Writer& w) {
             sb_mesh_data mesh = quad();
             mesh.indices16 = nullptr;
             sb_mesh(w.sb, &mesh);
         }},
        {"no positions",
         [](Writer& w) {
             const sb_mesh_data mesh{};
             sb_mesh(w.sb, &mesh);
         }},
        {"position 1 is not finite",
         [&](Writer& w) {
             auto corners = kQuad;
             corners[4] = nan;
             sb_mesh_data mesh = quad();
             mesh.positions = corners.data();
             sb_mesh(w.sb, &mesh);
         }},
        {"mask without texture coordinates",
         [](Writer& w) {
             sb_mesh_data mesh = quad();
             mesh.mask_rgba = reinterpret_cast<const std::uint8_t*>(kQuad.data());
             mesh.mask_width = mesh.mask_height = 1;
             sb_mesh(w.sb, &mesh);
         }},
        {"there is no mesh;", [](Writer& w) { sb_mesh(w.sb, nullptr); }},
        {"there is no image;", [](Writer& w) { sb_image(w.sb, nullptr); }},
        {"0 x 2 is no size", [](Writer& w) { w.depth_image(0, 2); }},
        {"20000 x 1 is no size", [](Writer& w) { w.depth_image(20000, 1); }},
        {"there are no texels",
         [](Writer& w) {
             const sb_image_data image = image_of(nullptr, SB_F32, 2, 2);
             sb_image(w.sb, &image);
         }},
        {"row_bytes is 4, a row has 8 bytes",
         [](Writer& w) {
             sb_image_data image = image_of(kQuad.data(), SB_F32, 2, 2);
             image.row_bytes = 4;
             sb_image(w.sb, &image);
         }},
        {"no channel 1 of 1",
         [](Writer& w) {
             sb_image_data image = image_of(kQuad.data(), SB_F32, 2, 2);
             image.channel = 1;
             sb_image(w.sb, &image);
         }},
        {"there is no image 7",
         [](Writer& w) { sb_map(w.sb, sb_light(w.sb, "", SB_SPOT), 7, Writer::identity(), SB_RANGE_0_TO_1, 0); }},
        {"there is no light 1", [](Writer& w) { sb_map(w.sb, 1, 0, Writer::identity(), SB_RANGE_0_TO_1, 0); }},
        {"no part of an image of 2 x 2", [](Writer& w) { sb_map_region(w.sb, w.add_map(), 1, 0, 2, 2); }},
        {"all maps of a bundle have one size",
         [](Writer& w) {
             w.add_map();
             sb_map(w.sb, 0, w.depth_image(4, 2), Writer::identity(), SB_RANGE_0_TO_1, 0);
         }},
        {"there is no instance 0",
         [](Writer& w) {
             const int wrong = 0;
             sb_map_drawn(w.sb, w.add_map(), &wrong, 1);
         }},
        {"there is no map 4", [](Writer& w) { sb_map_clear(w.sb, 4, 1); }},
        {"interval is empty", [](Writer& w) { sb_map_interval(w.sb, w.add_map(), 2, 2); }},
        {"parameter is not above 0", [](Writer& w) { sb_map_stored(w.sb, w.add_map(), SB_STORED_EXPONENTIAL, 0); }},
        {"none of the 5 choices", [](Writer& w) { sb_map_format(w.sb, w.add_map(), sb_format(9)); }},
        {"metres_per_unit is not above 0", [](Writer& w) { sb_world(w.sb, SB_UP_Y, SB_RIGHT_HANDED, 0, nullptr); }},
        {"direction is 0 0 0",
         [](Writer& w) { sb_light_direction(w.sb, sb_light(w.sb, "", SB_DIRECTIONAL), 0, 0, 0); }},
        {"outside 0 to 180", [](Writer& w) { sb_light_cone(w.sb, sb_light(w.sb, "", SB_SPOT), 180); }},
        {"SB_CHOICE_FACE needs 6",
         [](Writer& w) {
             w.add_map();
             sb_light_choice(w.sb, 0, SB_CHOICE_FACE);
         }},
        {"at most 16 lights",
         [](Writer& w) {
             for (int i = 0; i < 17; ++i) sb_light(w.sb, "", SB_DIRECTIONAL);
         }},
        {"more than 16 maps",
         [](Writer& w) {
             const int light = sb_light(w.sb, "", SB_DIRECTIONAL), image = w.depth_image();
             for (int i = 0; i < 17; ++i) sb_map(w.sb, light, image, Writer::identity(), SB_RANGE_0_TO_1, 0);
         }},
        {"more than 4 MiB",
         [](Writer& w) {
             const std::vector<int> drawn(500000, w.place("A name of some length"));
             sb_map_drawn(w.sb, w.add_map(), drawn.data(), drawn.size());
         }},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.error);
        Writer w;
        c.spoil(w);
        const std::string first = sb_error(w.sb);
        // Later calls do nothing, and the first error stays.
        if (!first.empty()) {
            EXPECT_EQ(w.place("later"), -1);
        }
        const std::string error = w.end();
        EXPECT_NE(error.find(c.error), std::string::npos) << error;
        if (!first.empty()) {
            EXPECT_EQ(error, first);
        }
        EXPECT_FALSE(w.is_whole());
    }
}

TEST(ShadowBundle, NoFileIsReplaced) {
    TemporaryFolder folder;
    folder.write("kept.bundle/frame.json", "old");
    const fs::path kept = folder.path() / "kept.bundle", missing = folder.path() / "no/such.bundle";
    for (const auto& [path, error] :
         {std::pair{kept, "it exists already"}, {missing, "No such file"}, {fs::path(), "no name"}}) {
        std::array<char, 512> message{};
        shadow_bundle* sb = sb_begin(path.c_str(), nullptr);
        EXPECT_EQ(sb_light(sb, "sun", SB_DIRECTIONAL), -1);
        EXPECT_NE(sb_end(sb, message.data(), message.size()), SB_OK);
        EXPECT_NE(std::string(message.data()).find(error), std::string::npos) << message.data();
    }
    EXPECT_EQ(file_bytes(kept / "frame.json"), "old");
    EXPECT_EQ(std::distance(fs::recursive_directory_iterator(folder.path()), {}), 2);
}

TEST(ShadowBundle, OnlyAWholeBundleHasItsFrame) {
    Writer cancelled;
    cancelled.place("Tree");
    cancelled.add_map();
    sb_cancel(cancelled.sb);
    cancelled.sb = nullptr;
    EXPECT_FALSE(cancelled.is_whole());

    Writer whole;
    whole.place("Tree");
    whole.add_map();
    EXPECT_FALSE(whole.is_whole());
    ASSERT_EQ(whole.end(), "");
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(whole.folder.path()))
        files.insert(entry.path().filename().string());
    EXPECT_EQ(files, (std::set<std::string>{"frame.bundle", "frame.json", "map0.pfm", "scene.glb"}));
}

// A limit on the size of files stands for a full disk.
TEST(ShadowBundle, AFullDiskIsReported) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t bytes : {100u, 5000u}) {
        Writer w;
        const rlimit limit = {bytes, before.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
        // The first limit stops the map, the second one the scene.
        const int map = sb_map(w.sb, sb_light(w.sb, "sun", SB_DIRECTIONAL), w.depth_image(32, 32), Writer::identity(),
                               SB_RANGE_0_TO_1, 0);
        EXPECT_EQ(map == -1, bytes == 100u);
        for (int i = 0; i < 40; ++i) w.place("A mesh");
        const std::string error = w.end();
        setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_NE(error.find(bytes == 100u ? "map0.pfm: File too large" : "scene.glb: File too large"),
                  std::string::npos)
            << error;
        EXPECT_NE(error.find("free space"), std::string::npos) << error;
        EXPECT_FALSE(w.is_whole());
    }
    // frame.json itself is too large.
    Writer w;
    w.add_map();
    sb_note(w.sb, std::string(5000, 'n').c_str());
    const rlimit limit = {3000, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    const std::string error = w.end();
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_NE(error.find("frame.json.part: File too large"), std::string::npos) << error;
    EXPECT_FALSE(w.is_whole());
    std::signal(SIGXFSZ, handler);
}

TEST(ShadowBundle, EachLanguageAndLocaleWritesTheSameBytes) {
    const TemporaryFolder folder;
    std::map<std::string, std::string> first;
    for (const char* writer : {"c99", "c11", "cpp", "comma"}) {
        const fs::path path = folder.path() / (std::string(writer) + ".bundle");
        const ProcessResult run =
            run_shell("'" + std::string(SI_BUNDLE_WRITERS) + "/write_bundle_" + writer + "' '" + path.string() + "'");
        ASSERT_EQ(run.code, 0) << writer << ": " << run.err;
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::directory_iterator(path))
            files[entry.path().filename().string()] = file_bytes(entry.path());
        if (first.empty()) first = files;
        EXPECT_EQ(files.size(), 4u);
        EXPECT_TRUE(files == first) << writer;
    }
    EXPECT_EQ(Json::parse(first["frame.json"])["lights"][0]["lookup"]["bias"]["constant"], 0.0005);
}

}  // namespace
}  // namespace si
