// SPDX-License-Identifier: GPL-3.0-or-later
// What npm's dxf makes of the files: its polylines' length in the unit of the file, and their count.
const fs = require('fs');
const dxf = require('dxf');
for (const name of ['plain-mm', 'plain-in', 'laser', 'cnc']) {
  const helper = new dxf.Helper(fs.readFileSync(`${process.argv[2]}/${name}.dxf`, 'utf-8'));
  let total = 0;
  const { polylines } = helper.toPolylines();
  for (const { vertices } of polylines)
    for (let i = 1; i < vertices.length; ++i)
      total += Math.hypot(vertices[i][0] - vertices[i - 1][0], vertices[i][1] - vertices[i - 1][1]);
  console.log('RESULT', name, total, polylines.length);
}
