#include "scripting/objects/plant_drawing.h"

#include <lua.hpp>
#include <memory>
#include <vector>

#include "numerics/error.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline scripting {
namespace {

namespace fs = std::filesystem;

/// Reads the installed drawings in a separate Lua state: changes that a script made to its functions do not affect
/// them.
class DrawingReader {
  public:
    DrawingReader() : state_(luaL_newstate(), lua_close), folder_(shared_folder() / "report_templates") {
        if (!state_) throw std::bad_alloc();
        luaL_openlibs(state_.get());
    }

    std::vector<std::string> names() {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder_ / "drawings"))
            if (entry.path().extension() == ".lua" && holds_motion(entry.path())) found.push_back(entry.path().stem());
        std::sort(found.begin(), found.end());
        return found;
    }

    /// The drawing below the pieces that shapes.lua makes of it.
    PlantDrawing read(const std::string& name) {
        lua_State* L = state_.get();
        run(folder_ / "drawings" / (name + ".lua"));
        PlantDrawing plant;
        plant.width = number(-1, "width"), plant.height = number(-1, "height");
        lua_getfield(L, -1, "motion");
        each(-1, [&] { plant.parts.push_back(part()); });
        lua_pop(L, 1);
        run(folder_ / "filters/shapes.lua");
        lua_getfield(L, -1, "pieces");
        lua_pushvalue(L, -3);
        check(lua_pcall(L, 1, 1, 0));
        each(-1, [&] { plant.pieces.push_back(piece()); });
        lua_settop(L, 0);
        return plant;
    }

  private:
    void check(int outcome) {
        if (outcome == LUA_OK) return;
        const char* const message = lua_tostring(state_.get(), -1);
        throw EnvironmentError("a drawing cannot be read: {}",
                               message != nullptr ? Message::verbatim(message) : Message("no reason is given"));
    }
    void run(const fs::path& file) {
        check(luaL_loadfilex(state_.get(), file.c_str(), "t"));
        check(lua_pcall(state_.get(), 0, 1, 0));
    }
    bool holds_motion(const fs::path& file) {
        run(file);
        const bool holds = lua_getfield(state_.get(), -1, "motion") == LUA_TTABLE;
        lua_settop(state_.get(), 0);
        return holds;
    }
    double number(int index, const char* name, double otherwise = 0) {
        lua_State* L = state_.get();
        const double value = lua_getfield(L, index, name) == LUA_TNUMBER ? lua_tonumber(L, -1) : otherwise;
        lua_pop(L, 1);
        return value;
    }
    double entry(int index, lua_Integer place) {
        lua_rawgeti(state_.get(), index, place);
        const double value = lua_tonumber(state_.get(), -1);
        lua_pop(state_.get(), 1);
        return value;
    }
    std::string text(int index, const char* name) {
        lua_State* L = state_.get();
        const std::string value = lua_getfield(L, index, name) == LUA_TSTRING ? lua_tostring(L, -1) : "";
        lua_pop(L, 1);
        return value;
    }
    /// Each entry of the list at `index`, on top of the stack.
    template <class Read>
    void each(int index, const Read& read) {
        lua_State* L = state_.get();
        const int list = lua_absindex(L, index);
        for (lua_Integer i = 1; lua_rawgeti(L, list, i) != LUA_TNIL; lua_pop(L, 1), ++i) read();
        lua_pop(L, 1);
    }

    int place_of_part(const std::string& name) const {
        for (std::size_t i = 0; i < part_names_.size(); ++i)
            if (part_names_[i] == name) return static_cast<int>(i);
        return -1;
    }
    PlantPart part() {
        lua_State* L = state_.get();
        PlantPart part;
        part.signal = text(-1, "signal"), part.unit = text(-1, "unit"), part.on = place_of_part(text(-1, "on"));
        part.drawn_at = number(-1, "at"), part.by = number(-1, "by", 1);
        part.turns = lua_getfield(L, -1, "turn") == LUA_TTABLE;
        if (!part.turns) lua_pop(L, 1), lua_getfield(L, -1, "slide");
        part.x = entry(-1, 1), part.y = entry(-1, 2);
        lua_pop(L, 1);
        part_names_.push_back(text(-1, "part"));
        return part;
    }
    PlantShape piece() {
        lua_State* L = state_.get();
        PlantShape piece;
        lua_getfield(L, -1, "points");
        each(-1, [&] { piece.x.push_back(entry(-1, 1)), piece.y.push_back(entry(-1, 2)); });
        lua_pop(L, 1);
        piece.filled = lua_getfield(L, -1, "shade") == LUA_TNUMBER;
        lua_pop(L, 1);
        piece.look = number(-1, piece.filled ? "shade" : "width");
        std::vector<int> parts;  // one for all points, or one for each, beginning again where a line is closed
        if (lua_getfield(L, -1, "part") == LUA_TTABLE) {
            const int list = lua_absindex(L, -1);
            each(list, [&] { parts.push_back(lua_isstring(L, -1) ? place_of_part(lua_tostring(L, -1)) : -1); });
        } else {
            parts.push_back(lua_isstring(L, -1) ? place_of_part(lua_tostring(L, -1)) : -1);
        }
        lua_pop(L, 1);
        for (std::size_t i = 0; i < piece.x.size(); ++i) piece.part.push_back(parts[i % parts.size()]);
        return piece;
    }

    std::unique_ptr<lua_State, void (*)(lua_State*)> state_;
    fs::path folder_;
    std::vector<std::string> part_names_;
};

}  // namespace

PlantDrawing plant_drawing(const std::string& name) {
    DrawingReader reader;
    const std::vector<std::string> names = reader.names();
    if (std::find(names.begin(), names.end(), name) == names.end())
        throw InvalidArgument("unknown animated plant '{}'; the plants are {}", name, listed(names));
    return reader.read(name);
}

}  // namespace dynlab::inline scripting
