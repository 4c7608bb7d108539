#include "io/free_names.h"
#include "io/new_columns.h"

#include <gtest/gtest.h>

namespace knead::test {
namespace {

std::vector<NewColumn> named(const std::vector<std::string>& names) {
    std::vector<NewColumn> columns;
    for (const std::string& name : names)
        columns.push_back({name, ScalarType::float32, nullptr, nullptr, nullptr});
    return columns;
}

TEST(FreeNames, numbers_what_was_taken) {
    FreeNames names;
    EXPECT_EQ(names.take("red"), "red");
    EXPECT_TRUE(names.take_exactly("red_2"));
    EXPECT_EQ(names.take("red"), "red_3");
    EXPECT_EQ(names.take("red"), "red_4");
    const std::string longer(25, 'a');
    EXPECT_EQ(names.take(longer, 20), longer.substr(0, 20));
    EXPECT_EQ(names.take(longer, 20), longer.substr(0, 18) + "_2");
}

TEST(FreeNames, counts_on_where_very_many_have_one_name) {
    FreeNames names;
    for (int i = 0; i < 200'000; ++i) (void)names.take("a");
    EXPECT_EQ(names.take("a"), "a_200001");
}

TEST(NewColumns, get_legal_names_of_their_own) {
    std::vector<NewColumn> columns = named({"my column", "x", "", "my_column", "x"});
    const std::vector<std::string> words = make_names_legal(columns, is_word_letter, 100);
    std::vector<std::string> names;
    for (const NewColumn& column : columns) names.push_back(column.name);
    EXPECT_EQ(names, (std::vector<std::string>{"my_column_2", "x", "unnamed", "my_column", "x_2"}));
    ASSERT_EQ(words.size(), 3U);
    EXPECT_EQ(words[0], "the column 'my column' is called 'my_column_2' there");
}

TEST(NewColumns, are_told_by_name_as_far_as_a_sentence_goes) {
    EXPECT_EQ(columns_are({"a"}), "the column 'a' is");
    EXPECT_EQ(columns_are({"a", "b"}), "the columns 'a' and 'b' are");
    EXPECT_EQ(columns_are({"a", "b", "c"}), "the columns 'a', 'b' and 'c' are");
    const std::string many = columns_are(std::vector<std::string>(1000, std::string(1000, 'x')));
    EXPECT_LT(many.size(), 800U);
    EXPECT_TRUE(many.ends_with("…' and 987 more are")) << many;
}

} // namespace
} // namespace knead::test
