// SPDX-License-Identifier: GPL-3.0-or-later
// What OpenNURBS (npm's rhino3dm) reads of 3DM files: unit, and of every curve its name, layer, degree and 201 places at equal
// fractions of its domain, as one line of JSON a file. Usage: rhino_samples.js FILE.3dm …
const fs = require('fs');
const load = require('rhino3dm');
load().then((rhino) => {
  for (const path of process.argv.slice(2)) {
    const model = rhino.File3dm.fromByteArray(new Uint8Array(fs.readFileSync(path)));
    if (!model) {
      console.log(JSON.stringify({ path, unit: 'unreadable', curves: [] }));
      continue;
    }
    const layers = model.layers(), objects = model.objects(), curves = [];
    for (let i = 0; i < objects.count; ++i) {
      const object = objects.get(i), curve = object.geometry(), attributes = object.attributes();
      const [first, last] = curve.domain, places = [];
      for (let k = 0; k <= 200; ++k) places.push(curve.pointAt(first + (last - first) * k / 200));
      curves.push({ name: attributes.name, layer: layers.get(attributes.layerIndex).name, id: attributes.id,
        degree: curve.degree, valid: curve.isValid, places });
    }
    const unit = model.settings().modelUnitSystem;
    console.log(JSON.stringify({ path, unit: unit === rhino.UnitSystem.Millimeters ? 'mm' : unit === rhino.UnitSystem.Inches ? 'in' : 'other', curves }));
  }
});
