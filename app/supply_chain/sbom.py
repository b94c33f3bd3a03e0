"""The list of all parts (SBOM) as CycloneDX JSON: each part with version, licence, checksums, and what needs it."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime

from cyclonedx.contrib.license.factories import LicenseFactory
from cyclonedx.model import ExternalReference, ExternalReferenceType, HashAlgorithm, HashType, XsUri
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentScope, ComponentType
from cyclonedx.output.json import JsonV1Dot6
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from packageurl import PackageURL

from app.supply_chain.parts import PRODUCT, PROJECT, TESTS, UNKNOWN, Part
from rths_engine import __version__

ALGORITHMS = {"sha256": HashAlgorithm.SHA_256, "sha384": HashAlgorithm.SHA_384, "sha512": HashAlgorithm.SHA_512}
SCOPES = {PRODUCT: ComponentScope.REQUIRED, TESTS: ComponentScope.EXCLUDED}  # a part of an extra is optional


def document(found: Sequence[Part], made_at: datetime | None = None) -> str:
    """The SBOM as JSON text, valid by the schema of CycloneDX 1.6. Raises ValueError where it is not."""
    licences = LicenseFactory()
    product = Component(
        name=PROJECT,
        version=__version__,
        type=ComponentType.APPLICATION,
        bom_ref=PROJECT,
        licenses=[licences.make_from_string("MIT")],
    )
    bom = Bom()
    bom.metadata.component = product
    bom.metadata.timestamp = made_at or datetime.now(UTC)
    made = {(one.kind, one.name): _component(one, licences) for one in found}
    for component in made.values():
        bom.components.add(component)
    for one in found:
        needed = [made[one.kind, name] for name in one.needs if (one.kind, name) in made]
        bom.register_dependency(made[one.kind, one.name], needed)
    needed_elsewhere = {(one.kind, name) for one in found for name in one.needs}
    bom.register_dependency(product, [component for place, component in made.items() if place not in needed_elsewhere])
    text = str(JsonV1Dot6(bom).output_as_string(indent=2))
    if wrong := JsonStrictValidator(SchemaVersion.V1_6).validate_str(text):
        raise ValueError(f"the list of parts is not valid by the schema of CycloneDX 1.6: {wrong}")
    return text


def _component(part: Part, licences: LicenseFactory) -> Component:
    place, _, name = part.name.rpartition("/")
    address = PackageURL(part.kind, place or None, name, part.version)
    sums = [HashType(alg=ALGORITHMS[algorithm], content=digest) for algorithm, digest in part.checksums]
    files = ExternalReference(
        type=ExternalReferenceType.DISTRIBUTION, url=XsUri(str(address)), comment="every file of the release", hashes=sums
    )
    return Component(
        name=name,
        group=place or None,
        version=part.version,
        type=ComponentType.LIBRARY,
        bom_ref=f"{part.kind}:{part.name}",
        purl=address,
        scope=SCOPES.get(part.use, ComponentScope.OPTIONAL),
        licenses=[] if part.licence == UNKNOWN else [licences.make_from_string(part.licence)],
        external_references=[files] if sums else [],
    )
