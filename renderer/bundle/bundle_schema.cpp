#include "renderer/bundle/bundle_schema.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "renderer/bundle/bundle_members.h"

namespace si {
namespace {

using Schema = nlohmann::ordered_json;

Schema numbers_schema(int count) {
    return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", count}, {"maxItems", count}};
}

Schema kind_schema(const bundle::Text& kind) {
    return {{"type", "string"}, {"maxLength", kind.max_bytes}};
}
Schema kind_schema(const bundle::Path&) {
    return {{"type", "string"}, {"minLength", 1}, {"maxLength", 1000}, {"pattern", "^[^/\\\\:][^\\\\:]*$"}};
}
Schema kind_schema(const bundle::Number& kind) {
    constexpr double kAny = std::numeric_limits<double>::max();
    Schema out = {{"type", "number"}};
    if (kind.least > -kAny) out[kind.above ? "exclusiveMinimum" : "minimum"] = kind.least;
    if (kind.most < kAny) out["maximum"] = kind.most;
    return out;
}
Schema kind_schema(const bundle::Integer& kind) {
    Schema out = {{"type", "integer"}, {"minimum", kind.least}};
    if (kind.most < std::numeric_limits<int>::max()) out["maximum"] = kind.most;
    return out;
}
Schema kind_schema(const bundle::Switch&) {
    return {{"type", "boolean"}};
}
Schema kind_schema(const bundle::Matrix&) {
    return numbers_schema(16);
}
Schema kind_schema(const bundle::Vector&) {
    return numbers_schema(3);
}
Schema kind_schema(const bundle::Pair& kind) {
    Schema out = numbers_schema(2);
    out["items"] = kind_schema(bundle::Number{.least = kind.least, .most = kind.most});
    return out;
}
Schema kind_schema(const bundle::Warp&) {
    return numbers_schema(4);
}
Schema kind_schema(const bundle::Region&) {
    const Schema corner = kind_schema(bundle::Integer{0, kMaxBundleImageSide});
    const Schema side = kind_schema(bundle::Integer{1, kMaxBundleImageSide});
    return {{"type", "array"}, {"prefixItems", {corner, corner, side, side}}, {"minItems", 4}, {"maxItems", 4}};
}
Schema kind_schema(const bundle::Texts& kind) {
    return {{"type", "array"}, {"items", kind_schema(bundle::Text{})}, {"maxItems", kind.most}};
}
Schema kind_schema(const bundle::Dictionary&) {
    return {{"type", "object"}, {"additionalProperties", {{"type", {"string", "number", "boolean"}}}}};
}
Schema kind_schema(const bundle::BiasUnits&) {
    const std::string unit = "(depth|texels|metres)";
    return {{"type", "string"}, {"pattern", "^" + unit + " *, *" + unit + " *, *" + unit + "$"}};
}
template <typename T>
Schema kind_schema(const bundle::ChoiceOf<T>& kind) {
    Schema keys = Schema::array();
    for (const auto& [key, value] : kind.keys) keys.push_back(key);
    return {{"enum", keys}};
}

/// Collector of the schema of one object of frame.json.
class SchemaMembers {
public:
    void version(const char* name, int known) { add(name, {{"const", known}}, true); }
    template <typename Kind>
    void required(const char* name, const Kind& kind, typename Kind::Type&) {
        add(name, kind_schema(kind), true);
    }
    template <typename Kind>
    void value(const char* name, const Kind& kind, typename Kind::Type&, const typename Kind::Type&) {
        add(name, kind_schema(kind), false);
    }
    template <typename Kind>
    void optional(const char* name, const Kind& kind, std::optional<typename Kind::Type>&) {
        add(name, kind_schema(kind), false);
    }
    template <typename T>
    void object(const char* name, T&) {
        add(name, object_schema<T>(), false);
    }
    template <typename T>
    void required_object(const char* name, T&) {
        add(name, object_schema<T>(), true);
    }
    template <typename T>
    void optional_object(const char* name, std::optional<T>&) {
        add(name, object_schema<T>(), false);
    }
    template <typename T>
    void list(const char* name, std::vector<T>&, std::size_t least, std::size_t most) {
        add(name, {{"type", "array"}, {"items", object_schema<T>()}, {"minItems", least}, {"maxItems", most}}, true);
    }

    template <typename T>
    static Schema object_schema() {
        SchemaMembers found;
        T any;
        bundle::members(found, any);
        found.properties_["extras"] = true;
        Schema out = {{"type", "object"}, {"properties", found.properties_}, {"additionalProperties", false}};
        if (!found.required_.empty()) out["required"] = found.required_;
        return out;
    }

private:
    void add(const char* name, Schema schema, bool required) {
        properties_[name] = std::move(schema);
        if (required) required_.push_back(name);
    }
    Schema properties_ = Schema::object(), required_ = Schema::array();
};

}  // namespace

std::string bundle_schema() {
    Schema out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                  {"title", "frame.json of a bundle"},
                  {"description", "One frame of an engine with its shadow maps; docs/bundle.md explains each member."}};
    out.update(SchemaMembers::object_schema<Bundle>());
    return out.dump(1, ' ') + "\n";
}

}  // namespace si
