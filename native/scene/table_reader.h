/// Reads rows of a packed table by column, and says where a value is impossible.
#pragma once

#include <cmath>

#include "scene/shading_tables.h"

namespace trg {

/// One row of a table whose columns are `fields`.
class TableRow {
  public:
    TableRow(const Table& table, const char* name, const std::vector<const char*>& fields,
             int64_t row)
        : table_(table), name_(name), fields_(fields), row_(row) {}

    /// The next column; throws TableError unless it lies in [low, high].
    float next(float low, float high) {
        const float value = table_.data[row_ * table_.columns + column_];
        if (!(value >= low && value <= high)) fail(value, low, high);
        ++column_;
        return value;
    }
    float next() { return next(-3.0e38f, 3.0e38f); }
    float next_share() { return next(0.0f, 1.0f); }
    Vec3 next_vector() {
        const float x = next(), y = next(), z = next();
        return {x, y, z};
    }
    /// An index below `count`, or from `low` on.
    int32_t next_index(int32_t low, int64_t count) {
        const float value = next(static_cast<float>(low), static_cast<float>(count - 1));
        // A float beyond 2^24 may have been rounded up to `count`.
        if (value != std::floor(value) || static_cast<int64_t>(value) >= count) {
            --column_;
            fail(value, static_cast<float>(low), static_cast<float>(count - 1));
        }
        return static_cast<int32_t>(value);
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw TableError(std::string(name_) + ": row " + std::to_string(row_) + " " + what);
    }

  private:
    [[noreturn]] void fail(float value, float low, float high) const {
        fail("has " + std::string(fields_[column_]) + " = " + std::to_string(value) +
             (std::fabs(low) > 1e38f
                  ? ", expected a finite number"
                  : ", expected " + std::to_string(low) +
                        (high > 1e38f ? " or more" : " to " + std::to_string(high))));
    }

    const Table& table_;
    const char* name_;
    const std::vector<const char*>& fields_;
    int64_t row_;
    size_t column_ = 0;
};

/// Throws TableError unless a table that has rows has one column a field.
inline void check_columns(const Table& table, const char* name,
                          const std::vector<const char*>& fields) {
    if (table.rows == 0 || table.columns == static_cast<int64_t>(fields.size())) return;
    throw TableError(std::string(name) + ": expected " + std::to_string(fields.size()) +
                     " columns, got " + std::to_string(table.columns));
}

}  // namespace trg
