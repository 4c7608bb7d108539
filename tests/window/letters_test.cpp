// Letters that the window's own font does not have.

#include "app/letters.h"
#include "app/theme.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace knead::test {

namespace {

constexpr ImWchar alef = 0x05d0, hare = 0x514e, nobodys = 0xf123; // Hebrew, Chinese, private

std::set<ImWchar> foreign_in(std::string_view text) {
    std::set<ImWchar> letters;
    add_foreign_letters(text, letters);
    return letters;
}

} // namespace

TEST(Letters, OfEuropeAreNoForeignOnes) {
    EXPECT_TRUE(foreign_in("").empty());
    EXPECT_TRUE(foreign_in("Käse, Ωmega, заяц — “1 × 2” … ✓.ply").empty());
    EXPECT_EQ(foreign_in("a\u514e\u05d0\u514e.ply"), (std::set<ImWchar>{alef, hare}));
}

TEST(Letters, OfTextThatIsNoUtf8AreLeftOut) {
    EXPECT_EQ(foreign_in("\xff\xfe\u514e\xe5"), std::set<ImWchar>{hare});
    EXPECT_TRUE(foreign_in("\xe5\x85").empty());
    if (sizeof(ImWchar) == 2) {
        EXPECT_TRUE(foreign_in("\U0001f430.ply").empty()); // no place for it
    }
}

TEST(Letters, AreEachTakenFromOneFontThatIsThere) {
    EXPECT_TRUE(fonts_with({}).empty());
    std::set<ImWchar> found;
    for (const LettersOfFont& font : fonts_with({alef, hare, nobodys})) {
        EXPECT_TRUE(std::filesystem::is_regular_file(font.file)) << font.file;
        EXPECT_FALSE(font.letters.empty());
        for (const ImWchar letter : font.letters) EXPECT_TRUE(found.insert(letter).second) << letter;
    }
    EXPECT_FALSE(found.contains(nobodys));
    if (found.empty()) GTEST_SKIP() << "no font of this system has any of these letters";
}

// Loaded again and again, as names come.
TEST(Letters, StandBesideThoseOfTheOwnFont) {
    ImGuiContext* const context = ImGui::CreateContext();
    bool any = false;
    for (const std::set<ImWchar>& letters : {std::set<ImWchar>{}, {alef}, {alef, hare}}) {
        const Fonts fonts = apply_theme(1, letters);
        for (const ImFont* font : {fonts.text, fonts.small, fonts.bold, fonts.title}) {
            EXPECT_TRUE(font->FindGlyphNoFallback('k'));
            EXPECT_FALSE(font->FindGlyphNoFallback(nobodys));
            for (const LettersOfFont& other : fonts_with(letters))
                for (const ImWchar letter : other.letters) {
                    any = true;
                    EXPECT_TRUE(font->FindGlyphNoFallback(letter)) << letter;
                }
        }
    }
    ImGui::DestroyContext(context);
    if (!any) GTEST_SKIP() << "no font of this system has any of these letters";
}

} // namespace knead::test
