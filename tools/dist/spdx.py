"""Writes what is inside each download as SPDX 2.3: python3 tools/dist/spdx.py FOLDER

The list is kinemend-VERSION.spdx.json in the folder. Every file there is a package that contains Kinemend and the libraries
inside it; libraries that its package manager installs beside it are dependencies. The time is SOURCE_DATE_EPOCH.
"""
import datetime
import hashlib
import json
import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from dist.libraries import LIBRARIES, PARTS, project_version, version_of  # noqa: E402

# The part that the name of a download indicates.
NAMES = {r"kinemend_.*\.deb": "kinemend", r"libkinemend-dev_.*\.deb": "libkinemend-dev", r"kinemend-.*\.whl": "wheel",
         r"kinemend-.*-windows-x86_64\.zip": "windows", r"kinemend\.html": "html", r"kinemend-npm-.*\.tgz": "npm",
         r"kinemend_blender-.*\.zip": "blender", r"kinemend-.*-source\.tar\.gz": "source"}


def part_of(name):
    """Which part a download is; raises LookupError for a file that the table does not name."""
    for pattern, part in NAMES.items():
        if re.fullmatch(pattern, name):
            return part
    raise LookupError(f"{name}: no part of the downloads has such a name")


def identifier(name):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", name).strip("-")


def package(name, version, licence, home, **more):
    entry = {"SPDXID": identifier(name), "name": name, "licenseConcluded": licence, "licenseDeclared": licence,
             "copyrightText": "NOASSERTION", "downloadLocation": "NOASSERTION", "filesAnalyzed": False, **more}
    if version:
        entry["versionInfo"] = version
    if home:
        entry["homepage"] = home
    return entry


def relation(one, kind, other):
    return {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}


def document(downloads, version, seconds):
    """The list of `downloads`, a mapping of names to the SHA-256 of their bytes."""
    parts = {name: part_of(name) for name in sorted(downloads)}
    used = {library for part in parts.values() for library in PARTS[part]["holds"] + PARTS[part]["links"]}
    packages = [package("Kinemend", version, "Apache-2.0", "")]
    packages += [package(library.name, version_of(library), library.licence, library.home)
                 for library in LIBRARIES.values() if library.name in used]
    relations = []
    for name, part in parts.items():
        licences = sorted({"Apache-2.0", *(LIBRARIES[library].licence for library in PARTS[part]["holds"])})
        licence = " AND ".join(f"({one})" if " " in one else one for one in licences)
        packages.append(package(name, version, licence, "", packageFileName=name, licenseDeclared="Apache-2.0",
                                checksums=[{"algorithm": "SHA256", "checksumValue": downloads[name]}]))
        relations.append(relation("SPDXRef-DOCUMENT", "DESCRIBES", identifier(name)))
        relations += [relation(identifier(name), "CONTAINS", identifier(held)) for held in ["Kinemend", *PARTS[part]["holds"]]]
        relations += [relation(identifier(name), "DEPENDS_ON", identifier(needed)) for needed in PARTS[part]["links"]]
    digest = hashlib.sha256("".join(sorted(downloads.values())).encode()).hexdigest()
    created = datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    extracted = [{"licenseId": "LicenseRef-public-domain", "name": "Public domain",
                  "extractedText": "Parts of the MinGW-w64 runtime are in the public domain; its authors disclaim copyright."}]
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"kinemend-{version}",
            "documentNamespace": f"https://spdx.org/spdxdocs/kinemend-{version}-{digest}",
            "creationInfo": {"created": created, "creators": ["Organization: The Kinemend authors", "Tool: tools/dist/spdx.py"]},
            "packages": packages, "relationships": relations, "hasExtractedLicensingInfos": extracted}


def main():
    folder, version = pathlib.Path(sys.argv[1]), project_version()
    downloads = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir())}
    text = json.dumps(document(downloads, version, int(os.environ["SOURCE_DATE_EPOCH"])), indent=1, ensure_ascii=False)
    (folder / f"kinemend-{version}.spdx.json").write_text(text + "\n")


if __name__ == "__main__":
    main()
