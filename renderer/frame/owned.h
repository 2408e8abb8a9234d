// What single passes keep between frames.
#pragma once

#include <memory>
#include <typeindex>
#include <unordered_map>

namespace si {

/// One object of each type that is asked for, which stays where it is. A pass keeps its targets in a struct that only
/// its file knows.
class Owned {
public:
    template <typename T>
    T& get() {
        std::shared_ptr<void>& slot = all_[std::type_index(typeid(T))];
        if (!slot) slot = std::make_shared<T>();
        return *static_cast<T*>(slot.get());
    }
    /// Makes it as if it had never been used.
    template <typename T>
    void drop() {
        if (const auto found = all_.find(std::type_index(typeid(T))); found != all_.end())
            *static_cast<T*>(found->second.get()) = T();
    }

private:
    std::unordered_map<std::type_index, std::shared_ptr<void>> all_;
};

}  // namespace si
