#pragma once
// Errors of the outside world: a file, an argument, a device. One type, thrown where the trouble is met and
// shown by the program's main function or the editor's toast. Nothing found is std::optional, a numeric
// outcome is a status with words, and a broken invariant is require() (base/require.h).

#include "base/control_characters.h"

#include <stdexcept>
#include <string>

namespace knead {

// What went wrong, as the command line's exit code tells it.
enum class Trouble {
    numeric = 1,      // a system that cannot be solved
    usage = 2,        // an argument, or a device that is not there
    input = 3,        // a file that cannot be opened, read or understood
    check_failed = 4, // a recorded check does not hold
    output = 5,       // a file that cannot be written
};

// What to do about it, where that is something else at the command line than in the window. Who shows the
// error puts it into words: cli/cures.h, and edit/cures.h for the window.
enum class Cure {
    told,         // in the error's own words, or there is nothing
    give_cloud,   // name the cloud that a session is to be opened with
    open_session, // the file is no cloud but a session, and is of use as one
};

// One sentence for the person at the keyboard: what happened, where, and what to do about it.
class Error : public std::runtime_error {
public:
    // `place` is the file, with a line or an offset where one is known ("wave.knead:12", "scan.ply: byte
    // 812"); it may be empty for an argument. `words` says what is wrong and, unless `cure` does, what helps,
    // without a full stop at its end. Both are shown in one line, without_controls().
    Error(Trouble trouble, const std::string& place, const std::string& words, Cure cure = Cure::told)
        : std::runtime_error(without_controls(place.empty() ? words : place + ": " + words)),
          trouble_(trouble), cure_(cure) {}

    Trouble trouble() const { return trouble_; }
    Cure cure() const { return cure_; }

private:
    Trouble trouble_;
    Cure cure_;
};

// Thrown out of a long stage when its Progress says that it was cancelled. Not an error: nothing is wrong.
class Cancelled : public std::exception {
public:
    const char* what() const noexcept override { return "cancelled"; }
};

} // namespace knead
