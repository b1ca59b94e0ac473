// SPDX-License-Identifier: MIT
#include "export_command.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "command_files.h"
#include "exit_codes.h"
#include "sherd/formats/glb_read.h"
#include "sherd/formats/glb_write.h"
#include "sherd/formats/gltf_document.h"

namespace sherd::cli {

namespace {

using Names = std::vector<std::string>;

/// 9 significant digits name every float uniquely: equal positions stay equal, others differ.
void appendNumber(std::string& out, float value) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9);
    out += ' ';
    out.append(text.data(), end.ptr);
}

Names materialNames(const std::string& json) {
    Names names;
    const auto document = nlohmann::json::parse(json, nullptr, false);
    if (!document.is_object() || !document.contains("materials")) return names;
    for (const auto& material : document["materials"]) {
        const bool named =
            material.is_object() && material.contains("name") && material["name"].is_string();
        std::string name = named ? material["name"].get<std::string>() : "";
        if (name.empty()) name = "material_" + std::to_string(names.size());
        // OBJ ends a name at white space.
        for (char& c : name)
            if (static_cast<unsigned char>(c) <= ' ') c = '_';
        names.push_back(std::move(name));
    }
    return names;
}

/// A name that is a plain file name on every system.
std::string fileName(const std::string& name, size_t index) {
    std::string out;
    for (const char c : name) {
        const auto u = static_cast<unsigned char>(c);
        const bool plain = std::isalnum(u) != 0 || c == '-' || c == '_' || c == '.' || u >= 0x80;
        out += plain ? c : '_';
    }
    constexpr size_t kLongest = 100;  // file systems stop at 255 bytes, and suffixes follow
    if (out.size() > kLongest) out.resize(kLongest);
    if (out.find_first_not_of('.') == std::string::npos) out = "object" + std::to_string(index);
    return out;
}

class ObjWriter {
  public:
    ObjWriter(const FractureSet& set, const Names& materials) : set_(set), materials_(materials) {
        for (const Attribute& attribute : set.geometry.attributes) {
            if (attribute.semantic == "NORMAL") normals_ = &attribute;
            if (attribute.semantic == "TEXCOORD_0") texcoords_ = &attribute;
        }
        const RigidPose& pose = set.restPose;
        const glm::quat& q = pose.rotation;
        // Multiplying by an identity could still change -0 or round: leave the bits alone.
        turned_ = q.x != 0 || q.y != 0 || q.z != 0;
        moved_ = pose.translation != glm::vec3(0.0F);
    }

    std::string write(uint32_t fragment) {
        begin("fragment " + std::to_string(fragment));
        std::string faces;
        const std::vector<Primitive>& primitives = set_.geometry.primitives;
        for (size_t p = 0; p < primitives.size(); ++p) {
            if (primitives[p].exposedFrom > set_.fragments[fragment].level) continue;
            const Range range = set_.fragmentRanges[fragment * primitives.size() + p];
            appendFaces(faces, primitives[p], range, false);
        }
        appendVertices();
        return text_ + faces;
    }

    /// The sheets of all fragments together, turned round: as the medial surface bounds what it
    /// encloses.
    std::string writeMedial() {
        begin("medial surface");
        std::string faces;
        for (const Primitive& primitive : set_.geometry.primitives)
            if (primitive.sheet) appendFaces(faces, primitive, primitive.indices, true);
        appendVertices();
        return text_ + faces;
    }

  private:
    void begin(const std::string& what) {
        text_ = "# " + what + " of " + clean(set_.name) + "\n";
        attributeNumber_.resize(set_.geometry.positions.size(), 0);
        placeOf_.resize(set_.geometry.positions.size(), 0);
        for (const uint32_t v : order_) attributeNumber_[v] = placeOf_[v] = 0;  // of the one before
        positionNumber_.clear();
        places_.clear();
        order_.clear();
    }

    void appendFaces(std::string& faces, const Primitive& primitive, Range range, bool reversed) {
        if (range.count == 0) return;
        faces += "usemtl " + materialOf(primitive) + "\n";
        for (uint32_t i = range.first; i < range.first + range.count; i += 3) {
            const uint32_t* c = set_.geometry.indices.data() + i;
            appendFace(faces,
                       reversed ? std::array{c[2], c[1], c[0]} : std::array{c[0], c[1], c[2]});
        }
    }

    static std::string clean(std::string text) {
        for (char& c : text)
            if (static_cast<unsigned char>(c) < ' ') c = ' ';
        return text;
    }

    std::string materialOf(const Primitive& primitive) const {
        const int32_t material = set_.materials[primitive.material];
        return material < 0 ? "default" : materials_[static_cast<size_t>(material)];
    }

    /// Corners with equal positions share one "v", so that readers see a closed mesh.
    void number(uint32_t vertex) {
        if (attributeNumber_[vertex] != 0) return;
        order_.push_back(vertex);
        attributeNumber_[vertex] = static_cast<uint32_t>(order_.size());
        const glm::vec3& p = set_.geometry.positions[vertex];
        const auto [found, isNew] =
            positionNumber_.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(places_.size() + 1));
        if (isNew) places_.push_back(vertex);
        placeOf_[vertex] = found->second;
    }

    void appendCorner(std::string& faces, uint32_t vertex) const {
        faces += ' ';
        faces += std::to_string(placeOf_[vertex]);
        if (texcoords_ == nullptr && normals_ == nullptr) return;
        const std::string attribute = std::to_string(attributeNumber_[vertex]);
        faces += '/';
        if (texcoords_ != nullptr) faces += attribute;
        if (normals_ == nullptr) return;
        faces += '/';
        faces += attribute;
    }

    void appendFace(std::string& faces, const std::array<uint32_t, 3>& corner) {
        for (const uint32_t c : corner) number(c);
        const std::array<uint32_t, 3> place = {placeOf_[corner[0]], placeOf_[corner[1]],
                                               placeOf_[corner[2]]};
        // A triangle whose corners coincide is no face; the mesh stays closed without it.
        if (place[0] == place[1] || place[1] == place[2] || place[2] == place[0]) return;
        faces += 'f';
        for (const uint32_t c : corner) appendCorner(faces, c);
        faces += '\n';
    }

    void appendVector(const char* key, glm::vec3 v) {
        text_ += key;
        for (int a = 0; a < 3; ++a) appendNumber(text_, v[a]);
        text_ += '\n';
    }

    void appendVertices() {
        for (const uint32_t v : places_) {
            glm::vec3 p = set_.geometry.positions[v];
            if (turned_) p = set_.restPose.rotation * p;
            if (moved_) p += set_.restPose.translation;
            appendVector("v", p);
        }
        for (const uint32_t v : order_) {
            if (texcoords_ == nullptr) break;
            text_ += "vt";
            appendNumber(text_, texcoords_->values[2 * v]);
            appendNumber(text_, 1.0F - texcoords_->values[2 * v + 1]);
            text_ += '\n';
        }
        for (const uint32_t v : order_) {
            if (normals_ == nullptr) break;
            const float* n = &normals_->values[3 * v];
            const glm::vec3 normal(n[0], n[1], n[2]);
            appendVector("vn", turned_ ? set_.restPose.rotation * normal : normal);
        }
    }

    const FractureSet& set_;
    const Names& materials_;
    const Attribute* normals_ = nullptr;
    const Attribute* texcoords_ = nullptr;
    bool turned_ = false;
    bool moved_ = false;
    std::string text_;
    // Numbers count from 1, as OBJ does; 0: not used by this fragment.
    std::vector<uint32_t> attributeNumber_;
    std::vector<uint32_t> placeOf_;
    std::map<std::array<float, 3>, uint32_t> positionNumber_;
    std::vector<uint32_t> places_;  ///< one vertex per position
    std::vector<uint32_t> order_;   ///< one vertex per set of attributes
};

/// Attributes that OBJ can hold have a fixed width there.
Result<void> checkWidths(const FractureSet& set) {
    for (const Attribute& a : set.geometry.attributes)
        if ((a.semantic == "NORMAL" && a.components != 3) ||
            (a.semantic == "TEXCOORD_0" && a.components != 2))
            return fail(ErrorCode::invalidData, a.semantic + " has the wrong number of components",
                        set.name);
    return {};
}

/// Files and folders made so far; whatever is not kept goes again.
class Batch {
  public:
    Batch() = default;
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;
    ~Batch() {
        std::error_code ignored;
        for (const auto& file : staged_) std::filesystem::remove(file.temporary, ignored);
        if (kept_) return;
        while (!folders_.empty()) {
            std::filesystem::remove(folders_.back(), ignored);  // only if empty
            folders_.pop_back();
        }
    }

    Result<void> makeFolder(const std::filesystem::path& folder) {
        std::vector<std::filesystem::path> missing;
        std::error_code code;
        for (auto at = folder; !at.empty() && !std::filesystem::exists(at, code);
             at = at.parent_path()) {
            missing.push_back(at);
            if (at == at.parent_path()) break;
        }
        folders_.insert(folders_.end(), missing.rbegin(), missing.rend());
        std::filesystem::create_directories(folder, code);
        if (code || !std::filesystem::is_directory(folder, code))
            return fail(ErrorCode::fileWrite,
                        std::filesystem::is_regular_file(folder, code)
                            ? "this is a file; name a directory for the pieces"
                            : "the directory cannot be made; may you write there?",
                        folder.string());
        return {};
    }

    Result<void> stage(const std::filesystem::path& path, const std::string& text) {
        const std::filesystem::path temporary = path.string() + ".part";
        staged_.push_back({temporary, path});
        return writeFileWhole(temporary,
                              {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
    }

    Result<size_t> commit() {
        // What can be foreseen is looked at before the first file takes its place.
        std::error_code code;
        for (const auto& file : staged_)
            if (std::filesystem::is_directory(file.path, code))
                return fail(ErrorCode::fileWrite, "a directory is in the way of the file",
                            file.path.string());
        for (const auto& file : staged_) {
            std::filesystem::rename(file.temporary, file.path, code);
            if (code)
                return fail(ErrorCode::fileWrite, "cannot write the file: " + code.message(),
                            file.path.string());
        }
        kept_ = true;
        const size_t count = staged_.size();
        staged_.clear();
        return count;
    }

  private:
    struct Staged {
        std::filesystem::path temporary;
        std::filesystem::path path;
    };
    std::vector<Staged> staged_;
    std::vector<std::filesystem::path> folders_;
    bool kept_ = false;
};

Result<void> exportObject(const FractureSet& set, const Names& materials, bool medial,
                          const std::filesystem::path& folder, Batch& batch) {
    if (auto widths = checkWidths(set); !widths) return widths;
    if (auto made = batch.makeFolder(folder); !made) return made;
    ObjWriter writer(set, materials);
    if (medial) return batch.stage(folder / "medial.obj", writer.writeMedial());
    for (uint32_t k = 0; k < set.levels.size(); ++k) {
        uint32_t number = 0;
        for (const uint32_t f : fragmentsAtLevel(set, k)) {
            const std::string name =
                "level" + std::to_string(k) + "_fragment" + std::to_string(number++) + ".obj";
            if (auto staged = batch.stage(folder / name, writer.write(f)); !staged) return staged;
        }
    }
    return {};
}

Result<size_t> exportAll(const ExportArguments& arguments) {
    const auto bytes = readBytes(arguments.input);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    const auto document = parseGlb(*bytes, arguments.input.string());
    if (!document) return tl::unexpected<Error>(document.error());
    const auto sets = readFractureSets(arguments.input);
    if (!sets) return tl::unexpected<Error>(sets.error());
    if (sets->empty()) return size_t{0};
    const Names materials = materialNames(document->json);
    Batch batch;
    std::set<std::string> used;
    for (size_t s = 0; s < sets->size(); ++s) {
        std::filesystem::path folder = arguments.directory;
        if (sets->size() > 1) {
            std::string name = fileName((*sets)[s].name, s);
            while (!used.insert(name).second) name += "_" + std::to_string(s);
            folder /= name;
        }
        if (auto done = exportObject((*sets)[s], materials, arguments.medial, folder, batch); !done)
            return tl::unexpected<Error>(done.error());
    }
    return batch.commit();
}

}  // namespace

int runExport(const ExportArguments& arguments) {
    const auto count = exportAll(arguments);
    if (!count) return printError(count.error());
    if (*count == 0) {
        std::fprintf(stderr, "sherd-bake: %s: the file holds no fracture set; bake it first\n",
                     arguments.input.c_str());
        return kExitNoFractureSet;
    }
    std::printf("%zu files in %s\n", *count, arguments.directory.c_str());
    return kExitOk;
}

void addExportCommand(CLI::App& app, int& exitCode) {
    const auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command = app.add_subcommand(
        "export", "Write every fragment of every level as DIR/level<k>_fragment<i>.obj");
    command->add_option("BAKED", arguments->input, "The baked .glb")->required();
    command->add_option("-o,--output", arguments->directory, "The directory to write to")
        ->required();
    command->add_flag("--medial", arguments->medial,
                      "Write the medial surface alone, as DIR/medial.obj");
    command->footer(
        "Examples:\n  sherd-bake export out/vase.glb -o out/vase_pieces\n"
        "  sherd-bake export out/vase.glb -o out/vase_medial --medial");
    command->callback([arguments, &exitCode] { exitCode = runExport(*arguments); });
}

}  // namespace sherd::cli
