// What single passes keep between frames.
#pragma once

#include <memory>
#include <typeindex>
#include <unordered_map>

namespace si {

/// One object of each type that is asked for. A pass keeps its targets in a struct that only its file knows.
class Owned {
public:
    template <typename T>
    T& get() {
        std::shared_ptr<void>& slot = all_[std::type_index(typeid(T))];
        if (!slot) slot = std::make_shared<T>();
        return *static_cast<T*>(slot.get());
    }
    template <typename T>
    void drop() {
        all_.erase(std::type_index(typeid(T)));
    }

private:
    std::unordered_map<std::type_index, std::shared_ptr<void>> all_;
};

}  // namespace si
