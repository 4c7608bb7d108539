#include "bench/page_html.h"

#include "view/coloring.h"

#include <cmath>

namespace knead {

namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<style>
body { margin: 2em auto; max-width: 118em; padding: 0 1.5em; font: 15px/1.45 sans-serif; color: #222; background: #fff; }
h1, h2, h3 { font-weight: 600; line-height: 1.2; }
h2 { margin-top: 2.5em; border-top: 1px solid #ccc; padding-top: 1em; }
h3 { margin: 1.5em 0 0; font-size: 1em; }
p { max-width: 60em; }
.row { display: flex; flex-wrap: wrap; gap: 1em; }
figure { margin: 0; width: min-content; min-width: 15em; }
img { display: block; border: 1px solid #ddd; }
figcaption { font-size: 0.9em; margin-top: 0.3em; }
code { display: block; font-size: 0.85em; color: #555; overflow-wrap: anywhere; }
.scale { display: flex; align-items: center; gap: 0.7em; font-size: 0.9em; }
.scale span { width: 16em; height: 0.9em; }
.missing { border-left: 4px solid #b33; padding-left: 0.8em; }
</style>
)";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

std::string picture_html(const PagePicture& picture) {
    const std::string command =
        picture.command.empty() ? "" : "<code>" + escaped(picture.command) + "</code>";
    return "<figure><img src=\"" + escaped(picture.file) + "\" alt=\"" + escaped(picture.caption) +
           "\"><figcaption>" + escaped(picture.caption) + command + "</figcaption></figure>\n";
}

// The scale that view/coloring.h colours by, in nine steps.
std::string scale_html(const PageSection& section) {
    if (section.scale_low.empty() && section.scale_high.empty()) return {};
    std::string stops;
    for (int step = 0; step <= 8; ++step) {
        const glm::vec3 color = viridis(step / 8.0);
        stops += ", rgb(";
        for (int c = 0; c < 3; ++c) stops += (c ? "," : "") + std::to_string(std::lround(255 * color[c]));
        stops += ")";
    }
    return "<p class=\"scale\">" + escaped(section.scale_low) +
           " <span style=\"background: linear-gradient(to right" + stops + ")\"></span> " +
           escaped(section.scale_high) + "</p>\n";
}

std::string section_html(const PageSection& section) {
    std::string html = "<h2>" + escaped(section.title) + "</h2>\n<p>" + escaped(section.words) + "</p>\n" +
                       scale_html(section);
    for (const PageRow& row : section.rows) {
        if (!row.title.empty()) html += "<h3>" + escaped(row.title) + "</h3>\n";
        html += "<div class=\"row\">\n";
        for (const PagePicture& picture : row.pictures) html += picture_html(picture);
        html += "</div>\n";
    }
    for (const std::string& words : section.missing)
        html += "<p class=\"missing\">Missing: " + escaped(words) + "</p>\n";
    return html;
}

} // namespace

std::string page_html(const std::string& title, const std::string& words,
                      std::span<const PageSection> sections) {
    std::string html = head;
    html += "<title>" + escaped(title) + "</title>\n<body>\n<h1>" + escaped(title) + "</h1>\n<p>" +
            escaped(words) + "</p>\n";
    for (const PageSection& section : sections) html += section_html(section);
    return html + "</body>\n</html>\n";
}

} // namespace knead
