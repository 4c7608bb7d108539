#include "render/png.h"

#include "base/error.h"

#include <png.h>

namespace knead {

void write_png(const std::filesystem::path& path, const Picture& picture) {
    FileInTheMaking file(path);
    write_png(file, picture);
    file.commit();
}

void write_png(FileInTheMaking& file, const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> bytes(size);
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr))
        throw Error(Trouble::output, file.shown().string(),
                    std::string("the picture cannot be written: ") + image.message);
    bytes.resize(size);

    file.write(bytes);
}

} // namespace knead
