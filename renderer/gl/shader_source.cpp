#include "renderer/gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "renderer/base/embedded.h"
#include "renderer/base/error.h"

namespace si::gl {
namespace {

constexpr std::string_view kFolder = "shaders/";

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::string_view trimmed(std::string_view s) {
    while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
    while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
    return s;
}

std::map<std::string, std::string, std::less<>>& added_texts() {
    static std::map<std::string, std::string, std::less<>> texts;
    return texts;
}

}  // namespace

void add_shader_text(std::string path, std::string text) {
    added_texts().insert_or_assign(std::move(path), std::move(text));
}

bool mentions(std::string_view text, std::string_view identifier) {
    for (std::size_t at = text.find(identifier); at != std::string_view::npos; at = text.find(identifier, at + 1)) {
        const std::size_t end = at + identifier.size();
        if ((at == 0 || !is_word(text[at - 1])) && (end == text.size() || !is_word(text[end]))) return true;
    }
    return false;
}

std::filesystem::path ShaderSource::default_tree() {
#ifdef SI_SHADER_TREE
    return SI_SHADER_TREE;
#else
    return {};
#endif
}

ShaderSource::ShaderSource(std::filesystem::path tree) : tree_(std::move(tree)) {
    for (const auto& file : embedded_files())
        if (file.path.starts_with(kFolder)) texts_.emplace(file.path.substr(kFolder.size()), file.text);
    for (const auto& [path, text] : added_texts()) texts_.insert_or_assign(path, text);
    read_tree();
}

void ShaderSource::read_tree() {
    if (tree_.empty()) return;
    namespace fs = std::filesystem;
    const fs::path root = tree_ / "shaders";
    std::error_code ec;
    for (fs::recursive_directory_iterator it(root, ec), end; !ec && it != end; it.increment(ec)) {
        if (!it->is_regular_file(ec)) continue;
        const std::string name = fs::relative(it->path(), root, ec).generic_string();
        const auto time = std::int64_t(fs::last_write_time(it->path(), ec).time_since_epoch().count());
        if (ec || times_[name] == time) continue;
        std::ifstream in(it->path(), std::ios::binary);
        std::ostringstream text;
        text << in.rdbuf();
        // An editor that truncates before it writes leaves an empty file for a short time.
        if (!in || text.str().empty()) continue;
        times_[name] = time;
        texts_.insert_or_assign(name, text.str());
        ++generation_;
    }
}

bool ShaderSource::poll() {
    const auto before = generation_;
    read_tree();
    return generation_ != before;
}

std::string ShaderSource::expand(std::string_view path, const IncludeNames& names,
                                 std::vector<std::string>& files) const {
    const auto it = texts_.find(path);
    if (it == texts_.end()) throw Error(fmt::format("shaders/{}: no such shader file", path));
    if (std::find(files.begin(), files.end(), path) != files.end()) return {};
    const std::size_t number = files.size();
    files.emplace_back(path);
    std::string out = fmt::format("#line 1 {}\n", number);
    std::string_view rest = it->second;
    for (int line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view text = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (!trimmed(text).starts_with("#include")) {
            out.append(text).push_back('\n');
            continue;
        }
        std::string_view what = trimmed(trimmed(text).substr(8));
        if (what.starts_with('<')) {  // a system header in a file shared with C++
            out.push_back('\n');
            continue;
        }
        if (what.size() >= 2 && what.front() == '"') {
            what = what.substr(1, what.size() - 2);
        } else if (const auto named = names.find(what); named != names.end()) {
            what = named->second;
        } else {
            throw Error(fmt::format("shaders/{}:{}: {} stands for no file here", path, line, what));
        }
        if (!texts_.contains(std::string(what)))
            throw Error(fmt::format("shaders/{}:{}: includes {}, which does not exist", path, line, what));
        out += expand(what, names, files);
        out += fmt::format("#line {} {}\n", line + 1, number);
    }
    return out;
}

}  // namespace si::gl
