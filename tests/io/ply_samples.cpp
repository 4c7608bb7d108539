#include "io/ply_samples.h"

#include "io/ply.h"
#include "io/scalar_bytes.h"

namespace knead::test {

namespace {

// Writes scalars one after the other in an encoding.
class Values {
public:
    explicit Values(const SampleKind& kind) : kind_(kind) {}

    void add(ScalarType type, double value) {
        if (kind_.encoding == PlyEncoding::ascii) {
            text_ += std::to_string(static_cast<int>(value)) + " ";
            return;
        }
        std::array<std::byte, 8> native{};
        std::array<std::byte, 8> stored{};
        store_scalar(value, type, native.data());
        copy_scalar(native.data(), size_of(type), is_swapped(kind_.encoding), stored.data());
        text_.append(reinterpret_cast<const char*>(stored.data()), size_of(type));
    }

    void end_row() {
        if (kind_.encoding == PlyEncoding::ascii) text_ += kind_.line_end;
    }

    const std::string& text() const { return text_; }

private:
    const SampleKind& kind_;
    std::string text_;
};

std::string header(const SampleKind& kind) {
    const std::string& end = kind.line_end;
    const std::string type(ply_name_of(kind.coordinates));
    std::string text = "ply" + end + "format " + std::string(name_of(kind.encoding)) + " 1.0" + end +
                       "comment made by a test" + end + "obj_info num_cols 5" + end;
    if (kind.extra_elements) text += "element grid 2" + end + "property int rows" + end;
    text += "element vertex 5" + end;
    text += "property " + type + " x" + end + "property " + type + " y" + end;
    if (kind.lists) text += "property list uint8 int16 seen" + end;
    text += "property " + type + " z" + end + "property uchar red" + end;
    for (const char* axis : {"nx", "ny", "nz"}) text += std::string("property float32 ") + axis + end;
    if (kind.extra_elements)
        text += "element face 2" + end + "property list uchar int vertex_indices" + end +
                "property double weight" + end;
    return text + "end_header" + end;
}

void add_point(Values& values, const SampleKind& kind, int i) {
    values.add(kind.coordinates, 10 + i);
    values.add(kind.coordinates, 20 - i);
    if (kind.lists) {
        values.add(ScalarType::uint8, i);
        for (int k = 0; k < i; ++k) values.add(ScalarType::int16, i + k);
    }
    values.add(kind.coordinates, 30 + i % 2);
    values.add(ScalarType::uint8, 7 * i);
    for (const double normal : {0.0, 0.0, 1.0}) values.add(ScalarType::float32, normal);
    values.end_row();
}

} // namespace

std::vector<SampleKind> all_sample_kinds() {
    std::vector<SampleKind> kinds;
    for (const auto encoding :
         {PlyEncoding::ascii, PlyEncoding::binary_little_endian, PlyEncoding::binary_big_endian}) {
        bool more = false;
        for (const ScalarType type :
             {ScalarType::int8, ScalarType::uint8, ScalarType::int16, ScalarType::uint16, ScalarType::int32,
              ScalarType::uint32, ScalarType::float32, ScalarType::float64}) {
            kinds.push_back({encoding, type, more, true, "\n"});
            more = !more;
        }
        for (const bool lists : {false, true})
            for (const bool extra : {false, true})
                for (const char* end : {"\n", "\r\n", "\r"})
                    kinds.push_back({encoding, ScalarType::float32, lists, extra, end});
    }
    return kinds;
}

std::string sample(const SampleKind& kind) {
    Values values(kind);
    if (kind.extra_elements)
        for (const int rows : {3, 4}) {
            values.add(ScalarType::int32, rows);
            values.end_row();
        }
    for (int i = 0; i < static_cast<int>(sample_points); ++i) add_point(values, kind, i);
    if (kind.extra_elements)
        for (const int corners : {3, 0}) {
            values.add(ScalarType::uint8, corners);
            for (int k = 0; k < corners; ++k) values.add(ScalarType::int32, k);
            values.add(ScalarType::float64, 2);
            values.end_row();
        }
    return header(kind) + values.text();
}

std::string name_of(const SampleKind& kind) {
    const char* const end = kind.line_end == "\n" ? "LF" : kind.line_end == "\r" ? "CR" : "CRLF";
    return std::string(knead::name_of(kind.encoding)) + " " + std::string(knead::name_of(kind.coordinates)) +
           (kind.lists ? " lists" : "") + (kind.extra_elements ? " extra " : " ") + end;
}

} // namespace knead::test
