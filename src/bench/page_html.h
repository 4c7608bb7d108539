#pragma once
// The text of the evaluation's page.

#include <span>
#include <string>
#include <vector>

namespace knead {

struct PagePicture {
    std::string file;    // "bar-200.png", beside the page
    std::string caption; // what is seen
    std::string command; // what shows it again; empty: nothing does
};
struct PageRow {
    std::string title; // empty: none
    std::vector<PagePicture> pictures;
};
struct PageSection {
    std::string title, words;
    std::vector<PageRow> rows;
    std::vector<std::string> missing; // one sentence each
    // What the ends of the scale of colours (viridis) mean, where pictures have one; both empty: none has.
    std::string scale_low{}, scale_high{};
};

// A whole page in HTML, dark on light, with no script and nothing from elsewhere. All texts are plain: what
// HTML would read is escaped.
std::string page_html(const std::string& title, const std::string& words,
                      std::span<const PageSection> sections);

} // namespace knead
