#pragma once
// Names of columns, each used once.

#include <cstddef>
#include <limits>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace knead {

class FreeNames {
public:
    static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

    // Whether nobody had the name; it is taken now.
    bool take_exactly(const std::string& name) { return taken_.insert(name).second; }

    // The name, cut to `longest` letters (20 at least); where it was taken before, with the first number
    // behind it that makes it new: "red_2".
    std::string take(const std::string& name, std::size_t longest = no_limit) {
        std::string base = name.substr(0, longest);
        if (take_exactly(base)) return base;
        unsigned& number = numbers_.try_emplace(base, 2).first->second;
        while (true) {
            const std::string suffix = "_" + std::to_string(number++);
            std::string candidate = base.size() + suffix.size() > longest
                                        ? base.substr(0, longest - suffix.size()) + suffix
                                        : base + suffix;
            if (take_exactly(candidate)) return candidate;
        }
    }

private:
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, unsigned> numbers_; // the next to try for a name
};

} // namespace knead
