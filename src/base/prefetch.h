#pragma once
// Asking for memory before it is needed, where what comes next lies anywhere and a core would wait for it.

namespace knead {

// Brings an object of two cache lines at most into the nearest cache; it may lie anywhere, also where there
// is none any more. (A function that only does this compilers take for one without effect, and leave out
// calls to it and to whatever does nothing else: all of them have to be inlined always.)
template<typename Object>
[[gnu::always_inline]] inline void prefetch(const Object* object) {
    static_assert(sizeof(Object) <= 64 + alignof(Object), "it may lie in three lines");
    const char* first = reinterpret_cast<const char*>(object);
    __builtin_prefetch(first);
    if constexpr (sizeof(Object) > alignof(Object)) __builtin_prefetch(first + sizeof(Object) - 1);
}

} // namespace knead
