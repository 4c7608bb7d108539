#include "app/window_icon.h"

#include "base/require.h"

#include <png.h>

#include <span>

namespace knead {

namespace embedded {
extern const std::span<const unsigned char> icon_png; // data/desktop/knead.png
}

WindowIcon window_icon() {
    const std::span<const unsigned char> file = embedded::icon_png;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    require(png_image_begin_read_from_memory(&image, file.data(), file.size()) != 0,
            "the icon is a PNG file");
    require(image.width == image.height, "the icon is square");
    image.format = PNG_FORMAT_RGBA;
    WindowIcon icon{static_cast<int>(image.width), std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
    require(png_image_finish_read(&image, nullptr, icon.rgba.data(), 0, nullptr) != 0, "the icon is whole");
    return icon;
}

} // namespace knead
