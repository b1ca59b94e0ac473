// SPDX-License-Identifier: MIT
#include "import/obj_materials.h"

#include <algorithm>
#include <fstream>
#include <map>

#include "import/text_cursor.h"

namespace sherd {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMaxFileSize = uint64_t{1} << 28;

struct MtlEntry {
    std::array<double, 4> baseColor{0.8, 0.8, 0.8, 1.0};
    std::string texture;
    fs::path folder;
};

bool readFile(const fs::path& path, std::string& bytes) {
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kMaxFileSize) {
        return false;
    }
    std::ifstream in(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
    return !in.bad();
}

/// Files written on Windows name folders with backslashes.
fs::path resolve(const fs::path& folder, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return folder / fs::path(name);
}

/// The file name of a map statement, options skipped: "-s 1 1 1 -clamp on wood planks.png".
std::string textureName(const std::string& statement) {
    TextCursor cursor(statement);
    std::string rest = cursor.rest();
    while (rest.starts_with('-')) {
        TextCursor options(rest);
        const std::string option(options.word());
        float ignored = 0;
        if (option == "-s" || option == "-o" || option == "-t" || option == "-mm") {
            while (options.number(ignored)) {
            }
        } else {
            options.word();
        }
        std::string next = options.rest();
        if (next.size() >= rest.size()) break;
        rest = std::move(next);
    }
    return rest;
}

void readStatement(TextCursor& cursor, MtlEntry& entry) {
    const std::string_view word = cursor.word();
    float value = 0;
    if (word == "Kd") {
        for (size_t k = 0; k < 3; ++k) {
            if (cursor.number(value)) entry.baseColor[k] = std::clamp(value, 0.0F, 1.0F);
        }
    } else if (word == "d") {
        if (cursor.number(value)) entry.baseColor[3] = std::clamp(value, 0.0F, 1.0F);
    } else if (word == "Tr") {
        if (cursor.number(value)) entry.baseColor[3] = 1 - std::clamp(value, 0.0F, 1.0F);
    } else if (word == "map_Kd") {
        entry.texture = textureName(cursor.rest());
    }
}

void parseMtl(const std::string& text, const fs::path& folder,
              std::map<std::string, MtlEntry>& entries) {
    MtlEntry* current = nullptr;
    for (TextCursor cursor(text); !cursor.atEnd(); cursor.nextLine()) {
        TextCursor peek = cursor;
        if (peek.word() == "newmtl") {
            current = &entries[peek.rest()];
            *current = MtlEntry{};
            current->folder = folder;
        } else if (current != nullptr) {
            readStatement(cursor, *current);
        }
    }
}

std::string imageType(const std::string& bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    return {};
}

void loadTexture(const MtlEntry& entry, ObjMaterial& material, std::vector<std::string>& warnings) {
    std::string bytes;
    if (!readFile(resolve(entry.folder, entry.texture), bytes)) {
        warnings.push_back("the texture " + entry.texture + " of material " + material.name +
                           " was not found; its plain colour is used");
        return;
    }
    material.imageType = imageType(bytes);
    if (material.imageType.empty()) {
        warnings.push_back("the texture " + entry.texture + " of material " + material.name +
                           " is neither PNG nor JPEG; its plain colour is used");
        return;
    }
    material.image.assign(bytes.begin(), bytes.end());
    // Exporters disagree on what Kd means beside a texture; the texture alone is what is meant.
    for (size_t k = 0; k < 3; ++k) material.baseColor[k] = 1;
}

}  // namespace

std::vector<ObjMaterial> loadObjMaterials(const std::vector<std::string>& names,
                                          const std::vector<std::string>& files,
                                          const fs::path& folder,
                                          std::vector<std::string>& warnings) {
    std::map<std::string, MtlEntry> entries;
    for (const std::string& file : files) {
        const fs::path path = resolve(folder, file);
        std::string text;
        if (readFile(path, text)) {
            parseMtl(text, path.parent_path(), entries);
        } else {
            warnings.push_back("the material file " + file +
                               " was not found; materials keep default colours");
        }
    }
    std::vector<ObjMaterial> materials;
    for (const std::string& name : names) {
        ObjMaterial& material = materials.emplace_back();
        material.name = name;
        const auto found = entries.find(name);
        if (found == entries.end()) continue;
        material.baseColor = found->second.baseColor;
        if (!found->second.texture.empty()) loadTexture(found->second, material, warnings);
    }
    return materials;
}

}  // namespace sherd
