"""Every shipped deck is XML to a strict parser, too, so that editors and other programs can read it."""
import os
import sys
import xml.parsers.expat


def main(root):
    decks = [os.path.join(folder, name) for top in ("inputs", "apps", "tests") for folder, _, names in os.walk(os.path.join(root, top))
             for name in names if name.endswith(".xml")]
    if len(decks) < 100:
        sys.exit(f"only {len(decks)} decks found")
    wrong = []
    for deck in sorted(decks):
        try:
            with open(deck, "rb") as file:
                xml.parsers.expat.ParserCreate().Parse(file.read(), True)
        except xml.parsers.expat.ExpatError as error:
            wrong.append(f"{os.path.relpath(deck, root)}: {error}")
    sys.exit("\n".join(wrong) or None)


if __name__ == "__main__":
    main(sys.argv[1])
