#pragma once
// Letters that the window's own font does not have, such as those of Chinese or Hebrew file names: which of
// the system's fonts have them. Asks fontconfig.

#include <imgui.h>

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// First and last of each range of letters that the window's own font is loaded with, and a zero.
extern const ImWchar own_letters[];

// Adds the letters of a UTF-8 text that are in none of these ranges. Letters beyond ImGui's are left out.
void add_foreign_letters(std::string_view text, std::set<ImWchar>& letters);

// A font of the system, and which of the letters that were asked for are to be taken from it.
struct LettersOfFont {
    std::string file;
    int number = 0; // within the file
    std::vector<ImWchar> letters;
};

// Fonts that have these letters, the one that suits best first; each letter is in one of them, or in none
// where no font of the system has it.
std::vector<LettersOfFont> fonts_with(const std::set<ImWchar>& letters);

} // namespace knead
