#include "app/letters.h"

#include <fontconfig/fontconfig.h>
#include <imgui_internal.h>

#include <algorithm>
#include <memory>

namespace knead {

// The letters of Europe, Greek for the names of settings, and the signs that knead's own words use.
const ImWchar own_letters[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x0400, 0x052f, 0x2010, 0x2027,
                               0x2030, 0x205e, 0x2070, 0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff,
                               0x2300, 0x23ff, 0x25a0, 0x25ff, 0x2713, 0x2717, 0};

namespace {

bool is_own(unsigned letter) {
    for (const ImWchar* range = own_letters; *range; range += 2)
        if (letter >= range[0] && letter <= range[1]) return true;
    return false;
}

template<auto destroy>
struct Destroy {
    template<typename Held>
    void operator()(Held* held) const {
        destroy(held);
    }
};
using CharSet = std::unique_ptr<FcCharSet, Destroy<FcCharSetDestroy>>;
using Pattern = std::unique_ptr<FcPattern, Destroy<FcPatternDestroy>>;
using FontSet = std::unique_ptr<FcFontSet, Destroy<FcFontSetDestroy>>;
using Config = std::unique_ptr<FcConfig, Destroy<FcConfigDestroy>>;

// Outlines of a sans-serif face that have as many of these letters as there are, in fontconfig's order.
FontSet suitable_fonts(FcConfig* config, const std::set<ImWchar>& letters) {
    const CharSet wanted(FcCharSetCreate());
    for (const ImWchar letter : letters) FcCharSetAddChar(wanted.get(), letter);
    const Pattern pattern(FcPatternCreate());
    FcPatternAddCharSet(pattern.get(), FC_CHARSET, wanted.get());
    FcPatternAddString(pattern.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
    FcPatternAddBool(pattern.get(), FC_SCALABLE, FcTrue);
    FcConfigSubstitute(config, pattern.get(), FcMatchPattern);
    FcDefaultSubstitute(pattern.get());
    FcResult ignored = FcResultMatch;
    return FontSet(FcFontSort(config, pattern.get(), FcTrue, nullptr, &ignored));
}

// Takes from `left` what the font has.
LettersOfFont take_letters(FcPattern* font, std::set<ImWchar>& left) {
    LettersOfFont taken;
    FcChar8* file = nullptr;
    FcCharSet* has = nullptr;
    FcBool is_outline = FcFalse;
    if (FcPatternGetBool(font, FC_OUTLINE, 0, &is_outline) != FcResultMatch || !is_outline ||
        FcPatternGetString(font, FC_FILE, 0, &file) != FcResultMatch ||
        FcPatternGetCharSet(font, FC_CHARSET, 0, &has) != FcResultMatch)
        return taken;
    FcPatternGetInteger(font, FC_INDEX, 0, &taken.number);
    taken.file = reinterpret_cast<const char*>(file);
    std::ranges::copy_if(left, std::back_inserter(taken.letters),
                         [&](ImWchar letter) { return FcCharSetHasChar(has, letter) != FcFalse; });
    for (const ImWchar letter : taken.letters) left.erase(letter);
    return taken;
}

} // namespace

void add_foreign_letters(std::string_view text, std::set<ImWchar>& letters) {
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        unsigned letter = static_cast<unsigned char>(*at);
        const int bytes = letter < 0x80 ? 1 : ImTextCharFromUtf8(&letter, at, end);
        if (bytes <= 0) break;
        at += bytes;
        if (letter > 0x20 && letter != IM_UNICODE_CODEPOINT_INVALID && letter <= IM_UNICODE_CODEPOINT_MAX &&
            !is_own(letter))
            letters.insert(static_cast<ImWchar>(letter));
    }
}

std::vector<LettersOfFont> fonts_with(const std::set<ImWchar>& letters) {
    std::vector<LettersOfFont> fonts;
    std::set<ImWchar> left = letters;
    if (left.empty()) return fonts;
    const Config config(FcInitLoadConfigAndFonts());
    if (!config) return fonts;
    const FontSet suitable = suitable_fonts(config.get(), letters);
    for (int i = 0; suitable && i < suitable->nfont && !left.empty(); ++i) {
        LettersOfFont font = take_letters(suitable->fonts[i], left);
        if (!font.letters.empty()) fonts.push_back(std::move(font));
    }
    return fonts;
}

} // namespace knead
