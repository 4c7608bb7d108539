#include "edit/cures.h"

#include "base/error.h"
#include "base/require.h"

#include <new>

namespace knead {

std::string words_in_window(const std::exception& error) {
    const auto* told = dynamic_cast<const Error*>(&error);
    const bool is_session = told && told->cure() == Cure::open_session;
    return std::string(error.what()) + (is_session ? "; Ctrl+O opens it" : "");
}

std::string words_about_exception() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        return no_memory;
    } catch (const BrokenInvariant& bug) {
        return std::string(mistake_in_knead) + ", and what is shown may be wrong: " + bug.what() +
               ". Save the session under another name, and open that one again.";
    } catch (const std::exception& error) {
        return words_in_window(error);
    }
}

} // namespace knead
