// The table of actions, and the keys that it leaves to the tools.

#include "app/actions.h"
#include "edit/tools_bench.h"

#include <string>
#include <string_view>

namespace knead::test {

namespace {

// "Ctrl+Shift+Z", as the menus write it.
KeyPress press_of(std::string_view keys) {
    KeyPress press{};
    const auto takes = [&](std::string_view modifier) {
        if (!keys.starts_with(modifier)) return false;
        keys.remove_prefix(modifier.size());
        return true;
    };
    press.held.ctrl = takes("Ctrl+");
    press.held.alt = takes("Alt+");
    press.held.shift = takes("Shift+");
    press.key = keys == "Enter"  ? Key::enter
                : keys == "Home" ? Key::home
                                 : key(keys.size() == 1 ? keys.front() : '\0');
    return press;
}

} // namespace

TEST(Actions, WhoseKeysAreOfTheToolsAreDoneByThem) {
    std::size_t of_tools = 0;
    for (const Action& action : actions()) {
        if (action.shortcut || std::string_view(action.keys).empty()) continue;
        Bench bench;
        EXPECT_TRUE(bench.take(press_of(action.keys))) << action.menu << ", " << action.label;
        ++of_tools;
    }
    EXPECT_GT(of_tools, 30U);
}

TEST(Actions, WhoseKeysAreOfTheWindowAreNoneOfTheTools) {
    for (const Action& action : actions()) {
        if (!action.shortcut) continue;
        Bench bench;
        EXPECT_FALSE(bench.take(KeyPress{action.shortcut->key, action.shortcut->held, false}))
            << action.menu << ", " << action.label << ": the tools would take it first";
    }
}

} // namespace knead::test
