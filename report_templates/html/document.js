// What a document offers on a screen besides its text: figures to zoom.
dynlabPlots.enliven(document);
