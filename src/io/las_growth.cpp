#include "io/las_growth.h"

#include "base/error.h"
#include "io/las_dimensions.h"
#include "io/scalar_bytes.h"

#include <algorithm>
#include <limits>

namespace knead {

namespace {

constexpr std::size_t largest_16_bits = std::numeric_limits<std::uint16_t>::max();

[[noreturn]] void refuse(const std::string& shown, const std::string& reason) {
    throw Error(Trouble::output, shown,
                "columns cannot be added, since " + reason + "; save it as .ply, or without them");
}

// Bytes at the end of a point that no entry describes come before the added ones, and so do their entries.
std::vector<std::byte> undescribed_bytes(std::size_t count) {
    std::vector<std::byte> entries;
    while (count > 0) {
        const std::size_t some = std::min<std::size_t>(count, 255);
        std::vector<std::byte> entry = las_descriptor("undescribed", ScalarType::uint8);
        entry[2] = std::byte{0};                 // bytes of no known meaning …
        entry[3] = static_cast<std::byte>(some); // … so many of them
        entries.insert(entries.end(), entry.begin(), entry.end());
        count -= some;
    }
    return entries;
}

// The last record before the points that describes extra bytes; null for none.
const LasRecord* description_in(const LasHeader& header, const std::string& shown) {
    const LasRecord* found = nullptr;
    for (const LasRecord& record : header.records) {
        if (!record.describes_extra_bytes) continue;
        if (record.extended) refuse(shown, "the file describes its extra bytes behind the points");
        found = &record;
    }
    return found;
}

// Describes the entries in the record that is there already, or in a new one. Returns by how much `head`
// grew.
std::size_t insert_entries(std::vector<std::byte>& head, const LasHeader& header,
                           std::vector<std::byte> entries, const std::string& shown) {
    const LasRecord* const description = description_in(header, shown);
    const std::size_t present = description != nullptr ? description->size : 0;
    if (present + entries.size() > largest_16_bits)
        refuse(shown, "the file describes as many as LAS can already");
    std::size_t at = load_little<std::uint16_t>(head, las_at::header_size);
    if (description != nullptr) {
        store_little(static_cast<std::uint16_t>(present + entries.size()), head, description->at + 20);
        at = description->begin + present - present % las_descriptor_size; // a reader sees whole entries only
    } else {
        for (const LasRecord& record : header.records)
            if (!record.extended) at = record.begin + record.size;
        std::vector<std::byte> record = las_extra_bytes_record(entries.size());
        entries.insert(entries.begin(), record.begin(), record.end());
        store_little(load_little<std::uint32_t>(head, las_at::record_count) + 1, head, las_at::record_count);
    }
    head.insert(head.begin() + static_cast<std::ptrdiff_t>(at), entries.begin(), entries.end());
    return entries.size();
}

// A place behind the points, if there is one.
void move_place(std::vector<std::byte>& head, std::size_t at, const LasHeader& header, std::uint64_t by) {
    const auto place = load_little<std::uint64_t>(head, at);
    if (place >= header.points_end()) store_little(place + by, head, at);
}

} // namespace

std::vector<std::byte> las_descriptor(std::string_view name, ScalarType type) {
    std::vector<std::byte> entry(las_descriptor_size);
    entry[2] = static_cast<std::byte>(las_type_code(type));
    store_text(name.substr(0, 32), entry, 4);
    return entry;
}

std::vector<std::byte> las_extra_bytes_record(std::size_t size) {
    std::vector<std::byte> record(las_record_header);
    store_text("LASF_Spec", record, 2);
    store_little<std::uint16_t>(4, record, 18);
    store_little(static_cast<std::uint16_t>(size), record, 20);
    store_text("Extra bytes", record, 22);
    return record;
}

void grow_las_head(std::vector<std::byte>& head, const LasHeader& header, std::span<const AddedColumn> added,
                   const std::string& shown) {
    if (added.empty()) return;
    std::vector<std::byte> entries = undescribed_bytes(header.undescribed);
    for (const AddedColumn& column : added) {
        const std::vector<std::byte> entry = las_descriptor(column.name, ScalarType::float32);
        entries.insert(entries.end(), entry.begin(), entry.end());
    }
    const std::size_t more = sizeof(float) * added.size();
    if (header.point_length + more > largest_16_bits) refuse(shown, "its points are as long as LAS allows");
    const std::size_t inserted = insert_entries(head, header, std::move(entries), shown);
    if (head.size() > std::numeric_limits<std::uint32_t>::max())
        refuse(shown, "its records fill 4 GB already");
    store_little(static_cast<std::uint16_t>(header.point_length + more), head, las_at::point_length);
    store_little(static_cast<std::uint32_t>(head.size()), head, las_at::points_begin);
    const std::uint64_t moved = inserted + std::uint64_t{more} * header.points;
    if (header.minor >= 3) move_place(head, las_at::waveforms, header, moved);
    if (header.minor >= 4) move_place(head, las_at::extended_begin, header, moved);
}

} // namespace knead
