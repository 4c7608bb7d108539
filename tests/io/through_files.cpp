#include "io/through_files.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace knead::test {

PointCloud read_bytes(std::string_view bytes, Progress& progress, const std::string& name) {
    const ScratchFolder folder;
    write_text(folder / name, bytes);
    return read_cloud(folder / name, progress);
}

PointCloud read_bytes(std::string_view bytes, const std::string& name) {
    SilentProgress progress;
    return read_bytes(bytes, progress, name);
}

std::string written(const PointCloud& cloud, const PosedShape& shape, const std::string& name,
                    std::vector<std::string>* heard) {
    const ScratchFolder folder;
    SilentProgress progress;
    std::vector<std::string> words = write_cloud(folder / name, cloud, shape, progress);
    if (heard != nullptr) *heard = std::move(words);
    return read_text(folder / name);
}

std::string refusal(std::string_view bytes, const std::string& name) {
    const ScratchFolder folder;
    write_text(folder / name, bytes);
    SilentProgress progress;
    try {
        read_cloud(folder / name, progress);
    } catch (const Error& error) {
        if (error.trouble() != Trouble::input) return "not an input error";
        const std::string words = error.what();
        return words.substr(words.find(name));
    }
    return "";
}

bool is_taken(std::string_view bytes, Reader read) {
    const auto* const begin = reinterpret_cast<const std::byte*>(bytes.data());
    SilentProgress progress;
    try {
        (void)read({begin, begin + bytes.size()}, "cloud", progress);
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::input) << error.what();
        return false;
    }
    return true;
}

std::string refusal_to_write(const PointCloud& cloud, const PosedShape& shape, const std::string& name) {
    try {
        (void)written(cloud, shape, name);
    } catch (const Error& error) {
        return error.trouble() == Trouble::output ? error.what() : "not an output error";
    }
    return "";
}

std::string joined(const std::vector<std::string>& sentences) {
    std::string all;
    for (const std::string& sentence : sentences) all += sentence + "\n";
    return all;
}

} // namespace knead::test
