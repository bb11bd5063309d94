// Numbers in fixed notation, also where the standard library cannot write them.
#pragma once

namespace kinemend {

// Each writes into [out, end), which must be long enough for any number, and returns the end of
// what it wrote.

/// Exactly rounded to so many decimals.
char* write_decimals(char* out, char* end, double value, unsigned decimals);
/// The fewest digits that are read as the same value.
char* write_round_trip(char* out, char* end, double value);
char* write_round_trip(char* out, char* end, float value);

/// The same by code that needs no `std::to_chars`, on every system.
char* write_decimals_anywhere(char* out, char* end, double value, unsigned decimals);
char* write_round_trip_anywhere(char* out, char* end, double value);
char* write_round_trip_anywhere(char* out, char* end, float value);

}  // namespace kinemend
