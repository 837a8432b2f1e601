; From route_search.cpp, SHA-256 856dd816c6e3e5029794eb569740e6dd4fe49841f3a2cb885851ffdd04fe5d4c, by tools/native.py. Do not edit.

%struct.Point = type { <16 x float>, <16 x float>, <16 x float> }
%struct.Frame = type { [9 x <16 x float>], [3 x <16 x float>] }
%struct.Motion = type { [17 x float], [17 x float], [136 x float], [136 x float] }
%struct.Joint = type { [9 x float], [3 x float], float }
%struct.Sphere = type { float, float, float, float }
%struct.Object = type { [9 x float], [3 x float], [3 x float], float, float, float }
%struct.LinkPair = type { i64, i64, i64, i64 }
%struct.Part = type { [3 x float], [3 x float], float, float }
%struct.PartPair = type { i64, i64 }
%struct.Point.7 = type { <8 x double>, <8 x double>, <8 x double> }
%struct.Frame.3 = type { [9 x <8 x double>], [3 x <8 x double>] }
%struct.Motion.2 = type { [17 x double], [17 x double], [136 x double], [136 x double] }
%struct.Piece = type { double, double }
%struct.Joint.6 = type { [9 x double], [3 x double], double }
%struct.Sphere.8 = type { double, double, double, double }
%struct.Object.9 = type { [9 x double], [3 x double], [3 x double], double, double, double }
%struct.Part.10 = type { [3 x double], [3 x double], double, double }
%struct.SpanPiece = type { i64, float, float }
%struct.Contact = type { %struct.SpanPiece, i64, double }
%struct.Tree = type { ptr, ptr, i64 }
%struct.Random = type { i64 }

define void @check_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, i64 noundef %3, float noundef %4, float noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = icmp sgt i64 %3, 0
  br i1 %8, label %10, label %9

9:
  ret void

10:
  %11 = phi i64 [ %19, %10 ], [ 0, %7 ]
  %12 = load i64, ptr %0, align 8
  %13 = mul nsw i64 %12, %11
  %14 = getelementptr inbounds float, ptr %1, i64 %13
  %15 = getelementptr inbounds float, ptr %2, i64 %13
  %16 = tail call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef %14, ptr noundef %15, float noundef %4, float noundef %5)
  %17 = zext i1 %16 to i8
  %18 = getelementptr inbounds i8, ptr %6, i64 %11
  store i8 %17, ptr %18, align 1
  %19 = add nuw nsw i64 %11, 1
  %20 = icmp eq i64 %19, %3
  br i1 %20, label %9, label %10
}

declare void @llvm.lifetime.start.p0(i64 immarg, ptr nocapture)

define internal fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, float noundef %3, float noundef %4) unnamed_addr {
  %6 = alloca [192 x %struct.Point], align 64
  %7 = alloca [2 x i64], align 16
  %8 = alloca [9 x <16 x float>], align 64
  %9 = alloca [16 x <16 x float>], align 64
  %10 = alloca [17 x <16 x float>], align 64
  %11 = alloca [136 x <16 x float>], align 64
  %12 = alloca [17 x %struct.Frame], align 64
  %13 = alloca %struct.Motion, align 4
  call void @llvm.lifetime.start.p0(i64 1224, ptr nonnull %13)
  %14 = getelementptr inbounds i8, ptr %13, i64 136
  %15 = load i64, ptr %0, align 8
  %16 = icmp slt i64 %15, 0
  br i1 %16, label %21, label %17

17:
  %18 = getelementptr inbounds i8, ptr %0, i64 112
  %19 = icmp eq i64 %15, 0
  %20 = load ptr, ptr %18, align 8
  br label %29

21:
  %22 = getelementptr inbounds i8, ptr %0, i64 16
  %23 = load i64, ptr %22, align 8
  %24 = icmp sgt i64 %23, 0
  br i1 %24, label %25, label %75

25:
  %26 = getelementptr inbounds i8, ptr %0, i64 120
  %27 = icmp sgt i64 %15, 0
  %28 = load ptr, ptr %26, align 8
  br label %52

29:
  %30 = phi i64 [ 0, %17 ], [ %50, %47 ]
  %31 = mul nuw nsw i64 %30, %15
  %32 = getelementptr inbounds float, ptr %20, i64 %31
  br i1 %19, label %47, label %33

33:
  %34 = phi i64 [ %45, %33 ], [ 0, %29 ]
  %35 = phi float [ %44, %33 ], [ 0.000000e+00, %29 ]
  %36 = getelementptr inbounds float, ptr %32, i64 %34
  %37 = load float, ptr %36, align 4
  %38 = getelementptr inbounds float, ptr %2, i64 %34
  %39 = load float, ptr %38, align 4
  %40 = fcmp contract olt float %39, 0.000000e+00
  %41 = fneg contract float %39
  %42 = select contract i1 %40, float %41, float %39
  %43 = fmul contract float %37, %42
  %44 = fadd contract float %35, %43
  %45 = add nuw nsw i64 %34, 1
  %46 = icmp eq i64 %45, %15
  br i1 %46, label %47, label %33

47:
  %48 = phi float [ 0.000000e+00, %29 ], [ %44, %33 ]
  %49 = getelementptr inbounds float, ptr %13, i64 %30
  store float %48, ptr %49, align 4
  %50 = add nuw i64 %30, 1
  %51 = icmp eq i64 %30, %15
  br i1 %51, label %21, label %29

52:
  %53 = phi i64 [ 0, %25 ], [ %73, %70 ]
  %54 = mul nsw i64 %53, %15
  %55 = getelementptr inbounds float, ptr %28, i64 %54
  br i1 %27, label %56, label %70

56:
  %57 = phi i64 [ %68, %56 ], [ 0, %52 ]
  %58 = phi float [ %67, %56 ], [ 0.000000e+00, %52 ]
  %59 = getelementptr inbounds float, ptr %55, i64 %57
  %60 = load float, ptr %59, align 4
  %61 = getelementptr inbounds float, ptr %2, i64 %57
  %62 = load float, ptr %61, align 4
  %63 = fcmp contract olt float %62, 0.000000e+00
  %64 = fneg contract float %62
  %65 = select contract i1 %63, float %64, float %62
  %66 = fmul contract float %60, %65
  %67 = fadd contract float %58, %66
  %68 = add nuw nsw i64 %57, 1
  %69 = icmp eq i64 %68, %15
  br i1 %69, label %70, label %56

70:
  %71 = phi float [ 0.000000e+00, %52 ], [ %67, %56 ]
  %72 = getelementptr inbounds float, ptr %14, i64 %53
  store float %71, ptr %72, align 4
  %73 = add nuw nsw i64 %53, 1
  %74 = icmp eq i64 %73, %23
  br i1 %74, label %75, label %52

75:
  br label %76

76:
  %77 = phi i64 [ %79, %76 ], [ 68, %75 ]
  %78 = getelementptr inbounds i8, ptr %13, i64 %77
  store float %4, ptr %78, align 4
  %79 = add nuw nsw i64 %77, 4
  %80 = icmp eq i64 %79, 136
  br i1 %80, label %110, label %76

81:
  br i1 %16, label %82, label %84

82:
  %83 = phi float [ 0.000000e+00, %81 ], [ %90, %84 ]
  br i1 %24, label %93, label %102

84:
  %85 = phi i64 [ %91, %84 ], [ 0, %81 ]
  %86 = phi float [ %90, %84 ], [ 0.000000e+00, %81 ]
  %87 = getelementptr inbounds [17 x float], ptr %13, i64 0, i64 %85
  %88 = load float, ptr %87, align 4
  %89 = fcmp contract ogt float %88, %86
  %90 = select i1 %89, float %88, float %86
  %91 = add nuw i64 %85, 1
  %92 = icmp eq i64 %85, %15
  br i1 %92, label %82, label %84

93:
  %94 = phi i64 [ %100, %93 ], [ 0, %82 ]
  %95 = phi float [ %99, %93 ], [ %83, %82 ]
  %96 = getelementptr inbounds [136 x float], ptr %14, i64 0, i64 %94
  %97 = load float, ptr %96, align 4
  %98 = fcmp contract ogt float %97, %95
  %99 = select i1 %98, float %97, float %95
  %100 = add nuw nsw i64 %94, 1
  %101 = icmp eq i64 %100, %23
  br i1 %101, label %102, label %93

102:
  %103 = phi float [ %83, %82 ], [ %99, %93 ]
  %104 = fmul contract float %3, 1.600000e+01
  %105 = fdiv contract float %103, %104
  %106 = fptosi float %105 to i64
  %107 = add i64 %106, 1
  %108 = shl nsw i64 %107, 4
  %109 = sitofp i64 %108 to float
  br label %154

110:
  %111 = phi i64 [ %113, %110 ], [ 680, %76 ]
  %112 = getelementptr inbounds i8, ptr %13, i64 %111
  store float %4, ptr %112, align 4
  %113 = add nuw nsw i64 %111, 4
  %114 = icmp eq i64 %113, 1224
  br i1 %114, label %81, label %110

115:
  %116 = icmp slt i64 %106, 0
  br i1 %116, label %1259, label %117

117:
  %118 = fdiv contract float 1.000000e+00, %109
  %119 = insertelement <16 x float> poison, float %118, i64 0
  %120 = shufflevector <16 x float> %119, <16 x float> poison, <16 x i32> zeroinitializer
  %121 = icmp sgt i64 %15, 0
  %122 = getelementptr inbounds i8, ptr %12, i64 576
  %123 = getelementptr inbounds i8, ptr %0, i64 24
  %124 = load ptr, ptr %123, align 8
  %125 = icmp slt i64 %15, 1
  %126 = getelementptr inbounds i8, ptr %13, i64 68
  %127 = getelementptr inbounds i8, ptr %13, i64 680
  %128 = getelementptr inbounds i8, ptr %0, i64 48
  %129 = load ptr, ptr %128, align 8
  %130 = getelementptr inbounds i8, ptr %0, i64 8
  %131 = load i64, ptr %130, align 8
  %132 = icmp sgt i64 %131, 0
  %133 = getelementptr inbounds i8, ptr %0, i64 56
  %134 = load ptr, ptr %133, align 8
  %135 = getelementptr inbounds i8, ptr %0, i64 64
  %136 = load ptr, ptr %135, align 8
  %137 = getelementptr inbounds i8, ptr %0, i64 32
  %138 = load ptr, ptr %137, align 8
  %139 = getelementptr inbounds i8, ptr %0, i64 40
  %140 = load ptr, ptr %139, align 8
  %141 = getelementptr inbounds i8, ptr %0, i64 96
  %142 = load ptr, ptr %141, align 8
  %143 = getelementptr inbounds i8, ptr %0, i64 88
  %144 = load ptr, ptr %143, align 8
  %145 = getelementptr inbounds i8, ptr %0, i64 128
  %146 = load ptr, ptr %145, align 8
  %147 = getelementptr inbounds i8, ptr %7, i64 8
  %148 = getelementptr inbounds i8, ptr %0, i64 80
  %149 = load ptr, ptr %148, align 8
  %150 = getelementptr inbounds i8, ptr %0, i64 72
  %151 = load ptr, ptr %150, align 8
  %152 = getelementptr inbounds i8, ptr %0, i64 104
  %153 = load ptr, ptr %152, align 8
  br label %167

154:
  %155 = phi i64 [ 0, %102 ], [ %161, %154 ]
  %156 = phi <16 x float> [ undef, %102 ], [ %160, %154 ]
  %157 = mul nsw i64 %155, %107
  %158 = add nsw i64 %157, 1
  %159 = sitofp i64 %158 to float
  %160 = insertelement <16 x float> %156, float %159, i64 %155
  %161 = add nuw nsw i64 %155, 1
  %162 = icmp eq i64 %161, 16
  br i1 %162, label %115, label %154

163:
  %164 = add nuw i64 %169, 1
  %165 = icmp sge i64 %169, %106
  %166 = icmp eq i64 %169, %106
  br i1 %166, label %1259, label %167

167:
  %168 = phi i1 [ false, %117 ], [ %165, %163 ]
  %169 = phi i64 [ 0, %117 ], [ %164, %163 ]
  %170 = uitofp nneg i64 %169 to float
  %171 = insertelement <16 x float> poison, float %170, i64 0
  %172 = shufflevector <16 x float> %171, <16 x float> poison, <16 x i32> zeroinitializer
  %173 = fadd contract <16 x float> %160, %172
  %174 = fmul contract <16 x float> %120, %173
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 1088, ptr nonnull %10)
  call void @llvm.lifetime.start.p0(i64 8704, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %12)
  br i1 %121, label %383, label %175

175:
  br label %176

176:
  %177 = phi i64 [ %184, %176 ], [ 0, %175 ]
  %178 = and i64 %177, 3
  %179 = icmp eq i64 %178, 0
  %180 = uitofp i1 %179 to float
  %181 = insertelement <16 x float> poison, float %180, i64 0
  %182 = shufflevector <16 x float> %181, <16 x float> poison, <16 x i32> zeroinitializer
  %183 = getelementptr inbounds [9 x <16 x float>], ptr %12, i64 0, i64 %177
  store <16 x float> %182, ptr %183, align 64
  %184 = add nuw nsw i64 %177, 1
  %185 = icmp eq i64 %184, 9
  br i1 %185, label %187, label %176

186:
  br i1 %121, label %193, label %398

187:
  %188 = phi i64 [ %190, %187 ], [ 0, %176 ]
  %189 = getelementptr inbounds [3 x <16 x float>], ptr %122, i64 0, i64 %188
  store <16 x float> zeroinitializer, ptr %189, align 64
  %190 = add nuw nsw i64 %188, 1
  %191 = icmp eq i64 %190, 3
  br i1 %191, label %186, label %187

192:
  br i1 %125, label %398, label %399

193:
  %194 = phi i64 [ %197, %381 ], [ 0, %186 ]
  %195 = getelementptr inbounds %struct.Joint, ptr %124, i64 %194
  %196 = getelementptr inbounds %struct.Frame, ptr %12, i64 %194
  %197 = add nuw nsw i64 %194, 1
  %198 = getelementptr inbounds <16 x float>, ptr %9, i64 %194
  %199 = load <16 x float>, ptr %198, align 64
  %200 = getelementptr inbounds i8, ptr %195, i64 36
  %201 = load float, ptr %200, align 4
  %202 = getelementptr inbounds i8, ptr %195, i64 40
  %203 = load float, ptr %202, align 4
  %204 = getelementptr inbounds i8, ptr %195, i64 44
  %205 = load float, ptr %204, align 4
  %206 = getelementptr inbounds i8, ptr %196, i64 576
  %207 = load <16 x float>, ptr %206, align 64
  %208 = load <16 x float>, ptr %196, align 64
  %209 = insertelement <16 x float> poison, float %201, i64 0
  %210 = shufflevector <16 x float> %209, <16 x float> poison, <16 x i32> zeroinitializer
  %211 = fmul contract <16 x float> %210, %208
  %212 = getelementptr inbounds i8, ptr %196, i64 64
  %213 = load <16 x float>, ptr %212, align 64
  %214 = insertelement <16 x float> poison, float %203, i64 0
  %215 = shufflevector <16 x float> %214, <16 x float> poison, <16 x i32> zeroinitializer
  %216 = fmul contract <16 x float> %215, %213
  %217 = getelementptr inbounds i8, ptr %196, i64 128
  %218 = load <16 x float>, ptr %217, align 64
  %219 = insertelement <16 x float> poison, float %205, i64 0
  %220 = shufflevector <16 x float> %219, <16 x float> poison, <16 x i32> zeroinitializer
  %221 = fmul contract <16 x float> %220, %218
  %222 = getelementptr inbounds i8, ptr %196, i64 640
  %223 = load <16 x float>, ptr %222, align 64
  %224 = getelementptr inbounds i8, ptr %196, i64 192
  %225 = load <16 x float>, ptr %224, align 64
  %226 = fmul contract <16 x float> %210, %225
  %227 = getelementptr inbounds i8, ptr %196, i64 256
  %228 = load <16 x float>, ptr %227, align 64
  %229 = fmul contract <16 x float> %215, %228
  %230 = getelementptr inbounds i8, ptr %196, i64 320
  %231 = load <16 x float>, ptr %230, align 64
  %232 = fmul contract <16 x float> %220, %231
  %233 = getelementptr inbounds i8, ptr %196, i64 704
  %234 = load <16 x float>, ptr %233, align 64
  %235 = getelementptr inbounds i8, ptr %196, i64 384
  %236 = load <16 x float>, ptr %235, align 64
  %237 = fmul contract <16 x float> %210, %236
  %238 = getelementptr inbounds i8, ptr %196, i64 448
  %239 = load <16 x float>, ptr %238, align 64
  %240 = fmul contract <16 x float> %215, %239
  %241 = getelementptr inbounds i8, ptr %196, i64 512
  %242 = load <16 x float>, ptr %241, align 64
  %243 = fmul contract <16 x float> %220, %242
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %8)
  br label %244

244:
  %245 = phi i64 [ 0, %193 ], [ %273, %272 ]
  %246 = mul nuw nsw i64 %245, 3
  %247 = getelementptr inbounds [9 x <16 x float>], ptr %196, i64 0, i64 %246
  %248 = load <16 x float>, ptr %247, align 64
  %249 = add nuw nsw i64 %246, 1
  %250 = getelementptr inbounds [9 x <16 x float>], ptr %196, i64 0, i64 %249
  %251 = load <16 x float>, ptr %250, align 64
  %252 = add nuw nsw i64 %246, 2
  %253 = getelementptr inbounds [9 x <16 x float>], ptr %196, i64 0, i64 %252
  %254 = load <16 x float>, ptr %253, align 64
  br label %275

255:
  %256 = getelementptr inbounds %struct.Frame, ptr %12, i64 %197
  %257 = fadd contract <16 x float> %207, %211
  %258 = fadd contract <16 x float> %257, %216
  %259 = fadd contract <16 x float> %258, %221
  %260 = fadd contract <16 x float> %223, %226
  %261 = fadd contract <16 x float> %260, %229
  %262 = fadd contract <16 x float> %261, %232
  %263 = fadd contract <16 x float> %234, %237
  %264 = fadd contract <16 x float> %263, %240
  %265 = fadd contract <16 x float> %264, %243
  %266 = getelementptr inbounds i8, ptr %256, i64 576
  store <16 x float> %259, ptr %266, align 64
  %267 = getelementptr inbounds i8, ptr %256, i64 640
  store <16 x float> %262, ptr %267, align 64
  %268 = getelementptr inbounds i8, ptr %256, i64 704
  store <16 x float> %265, ptr %268, align 64
  %269 = getelementptr inbounds i8, ptr %195, i64 48
  %270 = load float, ptr %269, align 4
  %271 = fcmp contract une float %270, 0.000000e+00
  br i1 %271, label %300, label %319

272:
  %273 = add nuw nsw i64 %245, 1
  %274 = icmp eq i64 %273, 3
  br i1 %274, label %255, label %244

275:
  %276 = phi i64 [ 0, %244 ], [ %298, %275 ]
  %277 = getelementptr inbounds [9 x float], ptr %195, i64 0, i64 %276
  %278 = load float, ptr %277, align 4
  %279 = insertelement <16 x float> poison, float %278, i64 0
  %280 = shufflevector <16 x float> %279, <16 x float> poison, <16 x i32> zeroinitializer
  %281 = fmul contract <16 x float> %248, %280
  %282 = add nuw nsw i64 %276, 3
  %283 = getelementptr inbounds [9 x float], ptr %195, i64 0, i64 %282
  %284 = load float, ptr %283, align 4
  %285 = insertelement <16 x float> poison, float %284, i64 0
  %286 = shufflevector <16 x float> %285, <16 x float> poison, <16 x i32> zeroinitializer
  %287 = fmul contract <16 x float> %251, %286
  %288 = fadd contract <16 x float> %281, %287
  %289 = add nuw nsw i64 %276, 6
  %290 = getelementptr inbounds [9 x float], ptr %195, i64 0, i64 %289
  %291 = load float, ptr %290, align 4
  %292 = insertelement <16 x float> poison, float %291, i64 0
  %293 = shufflevector <16 x float> %292, <16 x float> poison, <16 x i32> zeroinitializer
  %294 = fmul contract <16 x float> %254, %293
  %295 = fadd contract <16 x float> %288, %294
  %296 = add nuw nsw i64 %276, %246
  %297 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %296
  store <16 x float> %295, ptr %297, align 64
  %298 = add nuw nsw i64 %276, 1
  %299 = icmp eq i64 %298, 3
  br i1 %299, label %272, label %275

300:
  %301 = phi i64 [ %305, %300 ], [ 0, %255 ]
  %302 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %301
  %303 = load <16 x float>, ptr %302, align 64
  %304 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %301
  store <16 x float> %303, ptr %304, align 64
  %305 = add nuw nsw i64 %301, 1
  %306 = icmp eq i64 %305, 9
  br i1 %306, label %307, label %300

307:
  %308 = phi i64 [ %317, %307 ], [ 0, %300 ]
  %309 = mul nuw nsw i64 %308, 3
  %310 = add nuw nsw i64 %309, 2
  %311 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %310
  %312 = load <16 x float>, ptr %311, align 64
  %313 = fmul contract <16 x float> %199, %312
  %314 = getelementptr inbounds [3 x <16 x float>], ptr %266, i64 0, i64 %308
  %315 = load <16 x float>, ptr %314, align 64
  %316 = fadd contract <16 x float> %315, %313
  store <16 x float> %316, ptr %314, align 64
  %317 = add nuw nsw i64 %308, 1
  %318 = icmp eq i64 %317, 3
  br i1 %318, label %381, label %307

319:
  %320 = fmul contract <16 x float> %199, <float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000>
  %321 = fadd contract <16 x float> %320, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %322 = fadd contract <16 x float> %321, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %323 = fmul contract <16 x float> %322, <float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000>
  %324 = fsub contract <16 x float> %199, %323
  %325 = fmul contract <16 x float> %322, <float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000>
  %326 = fsub contract <16 x float> %324, %325
  %327 = fmul contract <16 x float> %322, <float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000>
  %328 = fsub contract <16 x float> %326, %327
  %329 = fmul contract <16 x float> %322, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %330 = fadd contract <16 x float> %329, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %331 = fadd contract <16 x float> %330, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %332 = fsub contract <16 x float> %329, %331
  %333 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %332)
  %334 = fmul contract <16 x float> %333, <float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00>
  %335 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %334
  %336 = fmul contract <16 x float> %328, %328
  %337 = fmul contract <16 x float> %328, %336
  %338 = fmul contract <16 x float> %336, <float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000>
  %339 = fadd contract <16 x float> %338, <float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000>
  %340 = fmul contract <16 x float> %336, %339
  %341 = fadd contract <16 x float> %340, <float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000>
  %342 = fmul contract <16 x float> %336, %341
  %343 = fadd contract <16 x float> %342, <float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000>
  %344 = fmul contract <16 x float> %337, %343
  %345 = fadd contract <16 x float> %328, %344
  %346 = fmul contract <16 x float> %335, %345
  %347 = fmul contract <16 x float> %336, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %348 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %347
  %349 = fmul contract <16 x float> %336, %336
  %350 = fmul contract <16 x float> %336, <float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000>
  %351 = fsub contract <16 x float> <float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000>, %350
  %352 = fmul contract <16 x float> %336, %351
  %353 = fadd contract <16 x float> %352, <float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000>
  %354 = fmul contract <16 x float> %336, %353
  %355 = fadd contract <16 x float> %354, <float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000>
  %356 = fmul contract <16 x float> %349, %355
  %357 = fadd contract <16 x float> %348, %356
  %358 = fmul contract <16 x float> %335, %357
  br label %359

359:
  %360 = phi i64 [ 0, %319 ], [ %379, %359 ]
  %361 = mul nuw nsw i64 %360, 3
  %362 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %361
  %363 = load <16 x float>, ptr %362, align 64
  %364 = fmul contract <16 x float> %358, %363
  %365 = add nuw nsw i64 %361, 1
  %366 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %365
  %367 = load <16 x float>, ptr %366, align 64
  %368 = fmul contract <16 x float> %346, %367
  %369 = fadd contract <16 x float> %364, %368
  %370 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %361
  store <16 x float> %369, ptr %370, align 64
  %371 = fmul contract <16 x float> %358, %367
  %372 = fmul contract <16 x float> %346, %363
  %373 = fsub contract <16 x float> %371, %372
  %374 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %365
  store <16 x float> %373, ptr %374, align 64
  %375 = add nuw nsw i64 %361, 2
  %376 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %375
  %377 = load <16 x float>, ptr %376, align 64
  %378 = getelementptr inbounds [9 x <16 x float>], ptr %256, i64 0, i64 %375
  store <16 x float> %377, ptr %378, align 64
  %379 = add nuw nsw i64 %360, 1
  %380 = icmp eq i64 %379, 3
  br i1 %380, label %381, label %359

381:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %8)
  %382 = icmp eq i64 %197, %15
  br i1 %382, label %192, label %193

383:
  %384 = phi i64 [ %396, %383 ], [ 0, %167 ]
  %385 = getelementptr inbounds float, ptr %1, i64 %384
  %386 = load float, ptr %385, align 4
  %387 = insertelement <16 x float> poison, float %386, i64 0
  %388 = shufflevector <16 x float> %387, <16 x float> poison, <16 x i32> zeroinitializer
  %389 = getelementptr inbounds float, ptr %2, i64 %384
  %390 = load float, ptr %389, align 4
  %391 = insertelement <16 x float> poison, float %390, i64 0
  %392 = shufflevector <16 x float> %391, <16 x float> poison, <16 x i32> zeroinitializer
  %393 = fmul contract <16 x float> %174, %392
  %394 = fadd contract <16 x float> %388, %393
  %395 = getelementptr inbounds [16 x <16 x float>], ptr %9, i64 0, i64 %384
  store <16 x float> %394, ptr %395, align 64
  %396 = add nuw nsw i64 %384, 1
  %397 = icmp eq i64 %396, %15
  br i1 %397, label %175, label %383

398:
  br i1 %24, label %414, label %413

399:
  %400 = phi i64 [ %411, %399 ], [ 1, %192 ]
  %401 = getelementptr inbounds [17 x float], ptr %13, i64 0, i64 %400
  %402 = load float, ptr %401, align 4
  %403 = insertelement <16 x float> poison, float %402, i64 0
  %404 = fmul contract <16 x float> %403, <float 0.000000e+00, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison>
  %405 = getelementptr inbounds [17 x float], ptr %126, i64 0, i64 %400
  %406 = load float, ptr %405, align 4
  %407 = insertelement <16 x float> poison, float %406, i64 0
  %408 = fadd contract <16 x float> %404, %407
  %409 = shufflevector <16 x float> %408, <16 x float> poison, <16 x i32> zeroinitializer
  %410 = getelementptr inbounds [17 x <16 x float>], ptr %10, i64 0, i64 %400
  store <16 x float> %409, ptr %410, align 64
  %411 = add nuw i64 %400, 1
  %412 = icmp eq i64 %400, %15
  br i1 %412, label %398, label %399

413:
  br i1 %125, label %751, label %428

414:
  %415 = phi i64 [ %426, %414 ], [ 0, %398 ]
  %416 = getelementptr inbounds [136 x float], ptr %14, i64 0, i64 %415
  %417 = load float, ptr %416, align 4
  %418 = insertelement <16 x float> poison, float %417, i64 0
  %419 = fmul contract <16 x float> %418, <float 0.000000e+00, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison, float poison>
  %420 = getelementptr inbounds [136 x float], ptr %127, i64 0, i64 %415
  %421 = load float, ptr %420, align 4
  %422 = insertelement <16 x float> poison, float %421, i64 0
  %423 = fadd contract <16 x float> %419, %422
  %424 = shufflevector <16 x float> %423, <16 x float> poison, <16 x i32> zeroinitializer
  %425 = getelementptr inbounds [136 x <16 x float>], ptr %11, i64 0, i64 %415
  store <16 x float> %424, ptr %425, align 64
  %426 = add nuw nsw i64 %415, 1
  %427 = icmp eq i64 %426, %23
  br i1 %427, label %413, label %414

428:
  %429 = phi <16 x i32> [ %748, %747 ], [ zeroinitializer, %413 ]
  %430 = phi i64 [ %749, %747 ], [ 1, %413 ]
  %431 = getelementptr inbounds %struct.Sphere, ptr %129, i64 %430
  %432 = getelementptr inbounds i8, ptr %431, i64 12
  %433 = load float, ptr %432, align 4
  %434 = fcmp contract olt float %433, 0.000000e+00
  br i1 %434, label %747, label %435

435:
  %436 = getelementptr inbounds %struct.Frame, ptr %12, i64 %430
  %437 = load float, ptr %431, align 4
  %438 = getelementptr inbounds i8, ptr %431, i64 4
  %439 = load float, ptr %438, align 4
  %440 = getelementptr inbounds i8, ptr %431, i64 8
  %441 = load float, ptr %440, align 4
  %442 = getelementptr inbounds i8, ptr %436, i64 576
  %443 = load <16 x float>, ptr %442, align 64
  %444 = load <16 x float>, ptr %436, align 64
  %445 = insertelement <16 x float> poison, float %437, i64 0
  %446 = shufflevector <16 x float> %445, <16 x float> poison, <16 x i32> zeroinitializer
  %447 = fmul contract <16 x float> %446, %444
  %448 = fadd contract <16 x float> %443, %447
  %449 = getelementptr inbounds i8, ptr %436, i64 64
  %450 = load <16 x float>, ptr %449, align 64
  %451 = insertelement <16 x float> poison, float %439, i64 0
  %452 = shufflevector <16 x float> %451, <16 x float> poison, <16 x i32> zeroinitializer
  %453 = fmul contract <16 x float> %452, %450
  %454 = fadd contract <16 x float> %448, %453
  %455 = getelementptr inbounds i8, ptr %436, i64 128
  %456 = load <16 x float>, ptr %455, align 64
  %457 = insertelement <16 x float> poison, float %441, i64 0
  %458 = shufflevector <16 x float> %457, <16 x float> poison, <16 x i32> zeroinitializer
  %459 = fmul contract <16 x float> %458, %456
  %460 = fadd contract <16 x float> %454, %459
  %461 = getelementptr inbounds i8, ptr %436, i64 640
  %462 = load <16 x float>, ptr %461, align 64
  %463 = getelementptr inbounds i8, ptr %436, i64 192
  %464 = load <16 x float>, ptr %463, align 64
  %465 = fmul contract <16 x float> %446, %464
  %466 = fadd contract <16 x float> %462, %465
  %467 = getelementptr inbounds i8, ptr %436, i64 256
  %468 = load <16 x float>, ptr %467, align 64
  %469 = fmul contract <16 x float> %452, %468
  %470 = fadd contract <16 x float> %466, %469
  %471 = getelementptr inbounds i8, ptr %436, i64 320
  %472 = load <16 x float>, ptr %471, align 64
  %473 = fmul contract <16 x float> %458, %472
  %474 = fadd contract <16 x float> %470, %473
  %475 = getelementptr inbounds i8, ptr %436, i64 704
  %476 = load <16 x float>, ptr %475, align 64
  %477 = getelementptr inbounds i8, ptr %436, i64 384
  %478 = load <16 x float>, ptr %477, align 64
  %479 = fmul contract <16 x float> %446, %478
  %480 = fadd contract <16 x float> %476, %479
  %481 = getelementptr inbounds i8, ptr %436, i64 448
  %482 = load <16 x float>, ptr %481, align 64
  %483 = fmul contract <16 x float> %452, %482
  %484 = fadd contract <16 x float> %480, %483
  %485 = getelementptr inbounds i8, ptr %436, i64 512
  %486 = load <16 x float>, ptr %485, align 64
  %487 = fmul contract <16 x float> %458, %486
  %488 = fadd contract <16 x float> %484, %487
  %489 = getelementptr inbounds <16 x float>, ptr %10, i64 %430
  %490 = load <16 x float>, ptr %489, align 64
  br i1 %132, label %491, label %747

491:
  %492 = mul nuw nsw i64 %131, %430
  %493 = getelementptr float, ptr %136, i64 %492
  %494 = getelementptr inbounds i64, ptr %138, i64 %430
  %495 = getelementptr inbounds i8, ptr %494, i64 8
  br label %496

496:
  %497 = phi <16 x i32> [ %429, %491 ], [ %744, %743 ]
  %498 = phi i64 [ 0, %491 ], [ %745, %743 ]
  %499 = getelementptr inbounds %struct.Object, ptr %134, i64 %498
  %500 = getelementptr float, ptr %493, i64 %498
  %501 = load float, ptr %500, align 4
  %502 = getelementptr inbounds i8, ptr %499, i64 60
  %503 = load float, ptr %502, align 4
  %504 = fadd contract float %501, %503
  %505 = fcmp contract olt float %504, -1.000000e+08
  br i1 %505, label %743, label %506

506:
  %507 = fadd contract float %433, %504
  %508 = insertelement <16 x float> poison, float %507, i64 0
  %509 = shufflevector <16 x float> %508, <16 x float> poison, <16 x i32> zeroinitializer
  %510 = fadd contract <16 x float> %490, %509
  %511 = fcmp contract ogt <16 x float> %510, zeroinitializer
  %512 = select contract <16 x i1> %511, <16 x float> %510, <16 x float> zeroinitializer
  %513 = getelementptr inbounds i8, ptr %499, i64 36
  %514 = load float, ptr %513, align 4
  %515 = insertelement <16 x float> poison, float %514, i64 0
  %516 = shufflevector <16 x float> %515, <16 x float> poison, <16 x i32> zeroinitializer
  %517 = load float, ptr %499, align 4
  %518 = insertelement <16 x float> poison, float %517, i64 0
  %519 = shufflevector <16 x float> %518, <16 x float> poison, <16 x i32> zeroinitializer
  %520 = fmul contract <16 x float> %460, %519
  %521 = fadd contract <16 x float> %516, %520
  %522 = getelementptr inbounds i8, ptr %499, i64 4
  %523 = load float, ptr %522, align 4
  %524 = insertelement <16 x float> poison, float %523, i64 0
  %525 = shufflevector <16 x float> %524, <16 x float> poison, <16 x i32> zeroinitializer
  %526 = fmul contract <16 x float> %474, %525
  %527 = fadd contract <16 x float> %521, %526
  %528 = getelementptr inbounds i8, ptr %499, i64 8
  %529 = load float, ptr %528, align 4
  %530 = insertelement <16 x float> poison, float %529, i64 0
  %531 = shufflevector <16 x float> %530, <16 x float> poison, <16 x i32> zeroinitializer
  %532 = fmul contract <16 x float> %488, %531
  %533 = fadd contract <16 x float> %527, %532
  %534 = getelementptr inbounds i8, ptr %499, i64 40
  %535 = load float, ptr %534, align 4
  %536 = insertelement <16 x float> poison, float %535, i64 0
  %537 = shufflevector <16 x float> %536, <16 x float> poison, <16 x i32> zeroinitializer
  %538 = getelementptr inbounds i8, ptr %499, i64 12
  %539 = load float, ptr %538, align 4
  %540 = insertelement <16 x float> poison, float %539, i64 0
  %541 = shufflevector <16 x float> %540, <16 x float> poison, <16 x i32> zeroinitializer
  %542 = fmul contract <16 x float> %460, %541
  %543 = fadd contract <16 x float> %537, %542
  %544 = getelementptr inbounds i8, ptr %499, i64 16
  %545 = load float, ptr %544, align 4
  %546 = insertelement <16 x float> poison, float %545, i64 0
  %547 = shufflevector <16 x float> %546, <16 x float> poison, <16 x i32> zeroinitializer
  %548 = fmul contract <16 x float> %474, %547
  %549 = fadd contract <16 x float> %543, %548
  %550 = getelementptr inbounds i8, ptr %499, i64 20
  %551 = load float, ptr %550, align 4
  %552 = insertelement <16 x float> poison, float %551, i64 0
  %553 = shufflevector <16 x float> %552, <16 x float> poison, <16 x i32> zeroinitializer
  %554 = fmul contract <16 x float> %488, %553
  %555 = fadd contract <16 x float> %549, %554
  %556 = getelementptr inbounds i8, ptr %499, i64 44
  %557 = load float, ptr %556, align 4
  %558 = insertelement <16 x float> poison, float %557, i64 0
  %559 = shufflevector <16 x float> %558, <16 x float> poison, <16 x i32> zeroinitializer
  %560 = getelementptr inbounds i8, ptr %499, i64 24
  %561 = load float, ptr %560, align 4
  %562 = insertelement <16 x float> poison, float %561, i64 0
  %563 = shufflevector <16 x float> %562, <16 x float> poison, <16 x i32> zeroinitializer
  %564 = fmul contract <16 x float> %460, %563
  %565 = fadd contract <16 x float> %559, %564
  %566 = getelementptr inbounds i8, ptr %499, i64 28
  %567 = load float, ptr %566, align 4
  %568 = insertelement <16 x float> poison, float %567, i64 0
  %569 = shufflevector <16 x float> %568, <16 x float> poison, <16 x i32> zeroinitializer
  %570 = fmul contract <16 x float> %474, %569
  %571 = fadd contract <16 x float> %565, %570
  %572 = getelementptr inbounds i8, ptr %499, i64 32
  %573 = load float, ptr %572, align 4
  %574 = insertelement <16 x float> poison, float %573, i64 0
  %575 = shufflevector <16 x float> %574, <16 x float> poison, <16 x i32> zeroinitializer
  %576 = fmul contract <16 x float> %488, %575
  %577 = fadd contract <16 x float> %571, %576
  %578 = fmul contract <16 x float> %533, zeroinitializer
  %579 = getelementptr inbounds i8, ptr %499, i64 68
  %580 = load float, ptr %579, align 4
  %581 = fcmp contract une float %580, 0.000000e+00
  %582 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %577)
  %583 = select contract i1 %581, <16 x float> %577, <16 x float> %582
  %584 = getelementptr inbounds i8, ptr %499, i64 64
  %585 = load float, ptr %584, align 4
  %586 = fcmp contract une float %585, 0.000000e+00
  br i1 %586, label %587, label %592

587:
  %588 = fmul contract <16 x float> %533, %533
  %589 = fmul contract <16 x float> %555, %555
  %590 = fadd contract <16 x float> %588, %589
  %591 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %590)
  br label %594

592:
  %593 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %533)
  br label %594

594:
  %595 = phi contract <16 x float> [ %591, %587 ], [ %593, %592 ]
  %596 = getelementptr inbounds i8, ptr %499, i64 48
  %597 = load float, ptr %596, align 4
  %598 = insertelement <16 x float> poison, float %597, i64 0
  %599 = shufflevector <16 x float> %598, <16 x float> poison, <16 x i32> zeroinitializer
  %600 = fsub contract <16 x float> %595, %599
  %601 = fcmp contract ogt <16 x float> %600, %578
  %602 = select contract <16 x i1> %601, <16 x float> %600, <16 x float> %578
  %603 = getelementptr inbounds i8, ptr %499, i64 56
  %604 = load float, ptr %603, align 4
  %605 = insertelement <16 x float> poison, float %604, i64 0
  %606 = shufflevector <16 x float> %605, <16 x float> poison, <16 x i32> zeroinitializer
  %607 = fsub contract <16 x float> %583, %606
  %608 = fcmp contract ogt <16 x float> %607, %578
  %609 = select contract <16 x i1> %608, <16 x float> %607, <16 x float> %578
  %610 = fmul contract <16 x float> %602, %602
  %611 = fmul contract <16 x float> %609, %609
  %612 = fadd contract <16 x float> %610, %611
  br i1 %586, label %624, label %613

613:
  %614 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %555)
  %615 = getelementptr inbounds i8, ptr %499, i64 52
  %616 = load float, ptr %615, align 4
  %617 = insertelement <16 x float> poison, float %616, i64 0
  %618 = shufflevector <16 x float> %617, <16 x float> poison, <16 x i32> zeroinitializer
  %619 = fsub contract <16 x float> %614, %618
  %620 = fcmp contract ogt <16 x float> %619, %578
  %621 = select contract <16 x i1> %620, <16 x float> %619, <16 x float> %578
  %622 = fmul contract <16 x float> %621, %621
  %623 = fadd contract <16 x float> %612, %622
  br label %624

624:
  %625 = phi <16 x float> [ %623, %613 ], [ %612, %594 ]
  %626 = fmul contract <16 x float> %512, %512
  %627 = fcmp contract olt <16 x float> %625, %626
  %628 = bitcast <16 x i1> %627 to i16
  %629 = icmp eq i16 %628, 0
  br i1 %629, label %743, label %630

630:
  %631 = load i64, ptr %494, align 8
  %632 = load i64, ptr %495, align 8
  %633 = icmp slt i64 %631, %632
  br i1 %633, label %634, label %737

634:
  %635 = getelementptr inbounds i8, ptr %499, i64 52
  br label %639

636:
  %637 = add i64 %641, 1
  %638 = icmp eq i64 %637, %632
  br i1 %638, label %737, label %639

639:
  %640 = phi <16 x i32> [ zeroinitializer, %634 ], [ %733, %636 ]
  %641 = phi i64 [ %631, %634 ], [ %637, %636 ]
  %642 = getelementptr inbounds %struct.Sphere, ptr %140, i64 %641
  %643 = getelementptr inbounds i8, ptr %642, i64 12
  %644 = load float, ptr %643, align 4
  %645 = fadd contract float %504, %644
  %646 = insertelement <16 x float> poison, float %645, i64 0
  %647 = shufflevector <16 x float> %646, <16 x float> poison, <16 x i32> zeroinitializer
  %648 = fadd contract <16 x float> %490, %647
  %649 = fcmp contract ogt <16 x float> %648, zeroinitializer
  %650 = select contract <16 x i1> %649, <16 x float> %648, <16 x float> zeroinitializer
  %651 = load float, ptr %642, align 4
  %652 = getelementptr inbounds i8, ptr %642, i64 4
  %653 = load float, ptr %652, align 4
  %654 = getelementptr inbounds i8, ptr %642, i64 8
  %655 = load float, ptr %654, align 4
  %656 = insertelement <16 x float> poison, float %651, i64 0
  %657 = shufflevector <16 x float> %656, <16 x float> poison, <16 x i32> zeroinitializer
  %658 = fmul contract <16 x float> %444, %657
  %659 = fadd contract <16 x float> %443, %658
  %660 = insertelement <16 x float> poison, float %653, i64 0
  %661 = shufflevector <16 x float> %660, <16 x float> poison, <16 x i32> zeroinitializer
  %662 = fmul contract <16 x float> %450, %661
  %663 = fadd contract <16 x float> %659, %662
  %664 = insertelement <16 x float> poison, float %655, i64 0
  %665 = shufflevector <16 x float> %664, <16 x float> poison, <16 x i32> zeroinitializer
  %666 = fmul contract <16 x float> %456, %665
  %667 = fadd contract <16 x float> %663, %666
  %668 = fmul contract <16 x float> %464, %657
  %669 = fadd contract <16 x float> %462, %668
  %670 = fmul contract <16 x float> %468, %661
  %671 = fadd contract <16 x float> %669, %670
  %672 = fmul contract <16 x float> %472, %665
  %673 = fadd contract <16 x float> %671, %672
  %674 = fmul contract <16 x float> %478, %657
  %675 = fadd contract <16 x float> %476, %674
  %676 = fmul contract <16 x float> %482, %661
  %677 = fadd contract <16 x float> %675, %676
  %678 = fmul contract <16 x float> %486, %665
  %679 = fadd contract <16 x float> %677, %678
  %680 = fmul contract <16 x float> %519, %667
  %681 = fadd contract <16 x float> %516, %680
  %682 = fmul contract <16 x float> %525, %673
  %683 = fadd contract <16 x float> %682, %681
  %684 = fmul contract <16 x float> %531, %679
  %685 = fadd contract <16 x float> %684, %683
  %686 = fmul contract <16 x float> %541, %667
  %687 = fadd contract <16 x float> %537, %686
  %688 = fmul contract <16 x float> %547, %673
  %689 = fadd contract <16 x float> %688, %687
  %690 = fmul contract <16 x float> %553, %679
  %691 = fadd contract <16 x float> %690, %689
  %692 = fmul contract <16 x float> %563, %667
  %693 = fadd contract <16 x float> %559, %692
  %694 = fmul contract <16 x float> %569, %673
  %695 = fadd contract <16 x float> %694, %693
  %696 = fmul contract <16 x float> %575, %679
  %697 = fadd contract <16 x float> %696, %695
  %698 = fmul contract <16 x float> %685, zeroinitializer
  %699 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %697)
  %700 = select contract i1 %581, <16 x float> %697, <16 x float> %699
  br i1 %586, label %701, label %706

701:
  %702 = fmul contract <16 x float> %685, %685
  %703 = fmul contract <16 x float> %691, %691
  %704 = fadd contract <16 x float> %702, %703
  %705 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %704)
  br label %708

706:
  %707 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %685)
  br label %708

708:
  %709 = phi contract <16 x float> [ %705, %701 ], [ %707, %706 ]
  %710 = fsub contract <16 x float> %709, %599
  %711 = fcmp contract ogt <16 x float> %710, %698
  %712 = select contract <16 x i1> %711, <16 x float> %710, <16 x float> %698
  %713 = fsub contract <16 x float> %700, %606
  %714 = fcmp contract ogt <16 x float> %713, %698
  %715 = select contract <16 x i1> %714, <16 x float> %713, <16 x float> %698
  %716 = fmul contract <16 x float> %712, %712
  %717 = fmul contract <16 x float> %715, %715
  %718 = fadd contract <16 x float> %717, %716
  br i1 %586, label %729, label %719

719:
  %720 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %691)
  %721 = load float, ptr %635, align 4
  %722 = insertelement <16 x float> poison, float %721, i64 0
  %723 = shufflevector <16 x float> %722, <16 x float> poison, <16 x i32> zeroinitializer
  %724 = fsub contract <16 x float> %720, %723
  %725 = fcmp contract ogt <16 x float> %724, %698
  %726 = select contract <16 x i1> %725, <16 x float> %724, <16 x float> %698
  %727 = fmul contract <16 x float> %726, %726
  %728 = fadd contract <16 x float> %718, %727
  br label %729

729:
  %730 = phi <16 x float> [ %728, %719 ], [ %718, %708 ]
  %731 = fmul contract <16 x float> %650, %650
  %732 = fcmp contract olt <16 x float> %730, %731
  %733 = select <16 x i1> %732, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %640
  %734 = icmp ne <16 x i32> %733, zeroinitializer
  %735 = bitcast <16 x i1> %734 to i16
  %736 = icmp eq i16 %735, 0
  br i1 %736, label %636, label %1254

737:
  %738 = phi <16 x i32> [ zeroinitializer, %630 ], [ %733, %636 ]
  %739 = or <16 x i32> %738, %497
  %740 = icmp eq <16 x i32> %739, zeroinitializer
  %741 = bitcast <16 x i1> %740 to i16
  %742 = icmp eq i16 %741, 0
  br i1 %742, label %1254, label %743

743:
  %744 = phi <16 x i32> [ %497, %624 ], [ %497, %496 ], [ %739, %737 ]
  %745 = add nuw nsw i64 %498, 1
  %746 = icmp eq i64 %745, %131
  br i1 %746, label %747, label %496

747:
  %748 = phi <16 x i32> [ %429, %428 ], [ %429, %435 ], [ %744, %743 ]
  %749 = add nuw i64 %430, 1
  %750 = icmp eq i64 %430, %15
  br i1 %750, label %751, label %428

751:
  %752 = phi <16 x i32> [ zeroinitializer, %413 ], [ %748, %747 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %6)
  br i1 %24, label %753, label %1252

753:
  %754 = phi <16 x i32> [ %1247, %1246 ], [ %752, %751 ]
  %755 = phi i64 [ %1248, %1246 ], [ 0, %751 ]
  %756 = phi i64 [ %1249, %1246 ], [ 0, %751 ]
  %757 = getelementptr inbounds %struct.LinkPair, ptr %142, i64 %756
  %758 = load i64, ptr %757, align 8
  %759 = getelementptr inbounds %struct.Sphere, ptr %144, i64 %758
  %760 = getelementptr inbounds i8, ptr %757, i64 8
  %761 = load i64, ptr %760, align 8
  %762 = getelementptr inbounds %struct.Sphere, ptr %144, i64 %761
  %763 = getelementptr inbounds %struct.Frame, ptr %12, i64 %758
  %764 = getelementptr inbounds %struct.Frame, ptr %12, i64 %761
  %765 = getelementptr inbounds <16 x float>, ptr %11, i64 %756
  %766 = load <16 x float>, ptr %765, align 64
  %767 = getelementptr inbounds float, ptr %146, i64 %756
  %768 = load float, ptr %767, align 4
  %769 = insertelement <16 x float> poison, float %768, i64 0
  %770 = shufflevector <16 x float> %769, <16 x float> poison, <16 x i32> zeroinitializer
  %771 = fadd contract <16 x float> %766, %770
  %772 = load float, ptr %762, align 4
  %773 = getelementptr inbounds i8, ptr %762, i64 4
  %774 = load float, ptr %773, align 4
  %775 = getelementptr inbounds i8, ptr %762, i64 8
  %776 = load float, ptr %775, align 4
  %777 = getelementptr inbounds i8, ptr %764, i64 576
  %778 = load <16 x float>, ptr %777, align 64
  %779 = load <16 x float>, ptr %764, align 64
  %780 = insertelement <16 x float> poison, float %772, i64 0
  %781 = shufflevector <16 x float> %780, <16 x float> poison, <16 x i32> zeroinitializer
  %782 = fmul contract <16 x float> %781, %779
  %783 = fadd contract <16 x float> %778, %782
  %784 = getelementptr inbounds i8, ptr %764, i64 64
  %785 = load <16 x float>, ptr %784, align 64
  %786 = insertelement <16 x float> poison, float %774, i64 0
  %787 = shufflevector <16 x float> %786, <16 x float> poison, <16 x i32> zeroinitializer
  %788 = fmul contract <16 x float> %787, %785
  %789 = fadd contract <16 x float> %783, %788
  %790 = getelementptr inbounds i8, ptr %764, i64 128
  %791 = load <16 x float>, ptr %790, align 64
  %792 = insertelement <16 x float> poison, float %776, i64 0
  %793 = shufflevector <16 x float> %792, <16 x float> poison, <16 x i32> zeroinitializer
  %794 = fmul contract <16 x float> %793, %791
  %795 = fadd contract <16 x float> %789, %794
  %796 = getelementptr inbounds i8, ptr %764, i64 640
  %797 = load <16 x float>, ptr %796, align 64
  %798 = getelementptr inbounds i8, ptr %764, i64 192
  %799 = load <16 x float>, ptr %798, align 64
  %800 = fmul contract <16 x float> %781, %799
  %801 = fadd contract <16 x float> %797, %800
  %802 = getelementptr inbounds i8, ptr %764, i64 256
  %803 = load <16 x float>, ptr %802, align 64
  %804 = fmul contract <16 x float> %787, %803
  %805 = fadd contract <16 x float> %801, %804
  %806 = getelementptr inbounds i8, ptr %764, i64 320
  %807 = load <16 x float>, ptr %806, align 64
  %808 = fmul contract <16 x float> %793, %807
  %809 = fadd contract <16 x float> %805, %808
  %810 = getelementptr inbounds i8, ptr %764, i64 704
  %811 = load <16 x float>, ptr %810, align 64
  %812 = getelementptr inbounds i8, ptr %764, i64 384
  %813 = load <16 x float>, ptr %812, align 64
  %814 = fmul contract <16 x float> %781, %813
  %815 = fadd contract <16 x float> %811, %814
  %816 = getelementptr inbounds i8, ptr %764, i64 448
  %817 = load <16 x float>, ptr %816, align 64
  %818 = fmul contract <16 x float> %787, %817
  %819 = fadd contract <16 x float> %815, %818
  %820 = getelementptr inbounds i8, ptr %764, i64 512
  %821 = load <16 x float>, ptr %820, align 64
  %822 = fmul contract <16 x float> %793, %821
  %823 = fadd contract <16 x float> %819, %822
  %824 = getelementptr inbounds i8, ptr %759, i64 12
  %825 = load float, ptr %824, align 4
  %826 = getelementptr inbounds i8, ptr %762, i64 12
  %827 = load float, ptr %826, align 4
  %828 = fadd contract float %825, %827
  %829 = insertelement <16 x float> poison, float %828, i64 0
  %830 = shufflevector <16 x float> %829, <16 x float> poison, <16 x i32> zeroinitializer
  %831 = fadd contract <16 x float> %771, %830
  %832 = fcmp contract ogt <16 x float> %831, zeroinitializer
  %833 = select contract <16 x i1> %832, <16 x float> %831, <16 x float> zeroinitializer
  %834 = load float, ptr %759, align 4
  %835 = getelementptr inbounds i8, ptr %759, i64 4
  %836 = load float, ptr %835, align 4
  %837 = getelementptr inbounds i8, ptr %759, i64 8
  %838 = load float, ptr %837, align 4
  %839 = getelementptr inbounds i8, ptr %763, i64 576
  %840 = load <16 x float>, ptr %839, align 64
  %841 = load <16 x float>, ptr %763, align 64
  %842 = insertelement <16 x float> poison, float %834, i64 0
  %843 = shufflevector <16 x float> %842, <16 x float> poison, <16 x i32> zeroinitializer
  %844 = fmul contract <16 x float> %843, %841
  %845 = fadd contract <16 x float> %840, %844
  %846 = getelementptr inbounds i8, ptr %763, i64 64
  %847 = load <16 x float>, ptr %846, align 64
  %848 = insertelement <16 x float> poison, float %836, i64 0
  %849 = shufflevector <16 x float> %848, <16 x float> poison, <16 x i32> zeroinitializer
  %850 = fmul contract <16 x float> %849, %847
  %851 = fadd contract <16 x float> %845, %850
  %852 = getelementptr inbounds i8, ptr %763, i64 128
  %853 = load <16 x float>, ptr %852, align 64
  %854 = insertelement <16 x float> poison, float %838, i64 0
  %855 = shufflevector <16 x float> %854, <16 x float> poison, <16 x i32> zeroinitializer
  %856 = fmul contract <16 x float> %855, %853
  %857 = fadd contract <16 x float> %851, %856
  %858 = getelementptr inbounds i8, ptr %763, i64 640
  %859 = load <16 x float>, ptr %858, align 64
  %860 = getelementptr inbounds i8, ptr %763, i64 192
  %861 = load <16 x float>, ptr %860, align 64
  %862 = fmul contract <16 x float> %843, %861
  %863 = fadd contract <16 x float> %859, %862
  %864 = getelementptr inbounds i8, ptr %763, i64 256
  %865 = load <16 x float>, ptr %864, align 64
  %866 = fmul contract <16 x float> %849, %865
  %867 = fadd contract <16 x float> %863, %866
  %868 = getelementptr inbounds i8, ptr %763, i64 320
  %869 = load <16 x float>, ptr %868, align 64
  %870 = fmul contract <16 x float> %855, %869
  %871 = fadd contract <16 x float> %867, %870
  %872 = getelementptr inbounds i8, ptr %763, i64 704
  %873 = load <16 x float>, ptr %872, align 64
  %874 = getelementptr inbounds i8, ptr %763, i64 384
  %875 = load <16 x float>, ptr %874, align 64
  %876 = fmul contract <16 x float> %843, %875
  %877 = fadd contract <16 x float> %873, %876
  %878 = getelementptr inbounds i8, ptr %763, i64 448
  %879 = load <16 x float>, ptr %878, align 64
  %880 = fmul contract <16 x float> %849, %879
  %881 = fadd contract <16 x float> %877, %880
  %882 = getelementptr inbounds i8, ptr %763, i64 512
  %883 = load <16 x float>, ptr %882, align 64
  %884 = fmul contract <16 x float> %855, %883
  %885 = fadd contract <16 x float> %881, %884
  %886 = fsub contract <16 x float> %857, %795
  %887 = fsub contract <16 x float> %871, %809
  %888 = fsub contract <16 x float> %885, %823
  %889 = fmul contract <16 x float> %886, %886
  %890 = fmul contract <16 x float> %887, %887
  %891 = fadd contract <16 x float> %889, %890
  %892 = fmul contract <16 x float> %888, %888
  %893 = fadd contract <16 x float> %891, %892
  %894 = fmul contract <16 x float> %833, %833
  %895 = fcmp contract olt <16 x float> %893, %894
  %896 = bitcast <16 x i1> %895 to i16
  %897 = icmp eq i16 %896, 0
  br i1 %897, label %1246, label %898

898:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %7)
  store i64 %758, ptr %7, align 16
  store i64 %761, ptr %147, align 8
  br label %905

899:
  %900 = getelementptr inbounds i8, ptr %757, i64 16
  %901 = load i64, ptr %900, align 8
  %902 = getelementptr inbounds i8, ptr %757, i64 24
  %903 = load i64, ptr %902, align 8
  %904 = icmp slt i64 %901, %903
  br i1 %904, label %986, label %1244

905:
  %906 = phi i64 [ %755, %898 ], [ %983, %982 ]
  %907 = phi i64 [ 0, %898 ], [ %984, %982 ]
  %908 = getelementptr inbounds i8, ptr %7, i64 %907
  %909 = load i64, ptr %908, align 8
  %910 = shl nuw i64 1, %909
  %911 = and i64 %910, %906
  %912 = icmp eq i64 %911, 0
  br i1 %912, label %913, label %982

913:
  %914 = or i64 %910, %906
  %915 = getelementptr inbounds i64, ptr %149, i64 %909
  %916 = load i64, ptr %915, align 8
  %917 = getelementptr i8, ptr %915, i64 8
  %918 = load i64, ptr %917, align 8
  %919 = icmp slt i64 %916, %918
  br i1 %919, label %920, label %982

920:
  %921 = getelementptr inbounds %struct.Frame, ptr %12, i64 %909
  %922 = getelementptr inbounds i8, ptr %921, i64 576
  %923 = load <16 x float>, ptr %922, align 64
  %924 = load <16 x float>, ptr %921, align 64
  %925 = getelementptr inbounds i8, ptr %921, i64 64
  %926 = load <16 x float>, ptr %925, align 64
  %927 = getelementptr inbounds i8, ptr %921, i64 128
  %928 = load <16 x float>, ptr %927, align 64
  %929 = getelementptr inbounds i8, ptr %921, i64 640
  %930 = load <16 x float>, ptr %929, align 64
  %931 = getelementptr inbounds i8, ptr %921, i64 192
  %932 = load <16 x float>, ptr %931, align 64
  %933 = getelementptr inbounds i8, ptr %921, i64 256
  %934 = load <16 x float>, ptr %933, align 64
  %935 = getelementptr inbounds i8, ptr %921, i64 320
  %936 = load <16 x float>, ptr %935, align 64
  %937 = getelementptr inbounds i8, ptr %921, i64 704
  %938 = load <16 x float>, ptr %937, align 64
  %939 = getelementptr inbounds i8, ptr %921, i64 384
  %940 = load <16 x float>, ptr %939, align 64
  %941 = getelementptr inbounds i8, ptr %921, i64 448
  %942 = load <16 x float>, ptr %941, align 64
  %943 = getelementptr inbounds i8, ptr %921, i64 512
  %944 = load <16 x float>, ptr %943, align 64
  br label %945

945:
  %946 = phi i64 [ %916, %920 ], [ %980, %945 ]
  %947 = getelementptr inbounds %struct.Part, ptr %151, i64 %946
  %948 = load float, ptr %947, align 4
  %949 = getelementptr inbounds i8, ptr %947, i64 4
  %950 = load float, ptr %949, align 4
  %951 = getelementptr inbounds i8, ptr %947, i64 8
  %952 = load float, ptr %951, align 4
  %953 = insertelement <16 x float> poison, float %948, i64 0
  %954 = shufflevector <16 x float> %953, <16 x float> poison, <16 x i32> zeroinitializer
  %955 = fmul contract <16 x float> %954, %924
  %956 = fadd contract <16 x float> %923, %955
  %957 = insertelement <16 x float> poison, float %950, i64 0
  %958 = shufflevector <16 x float> %957, <16 x float> poison, <16 x i32> zeroinitializer
  %959 = fmul contract <16 x float> %958, %926
  %960 = fadd contract <16 x float> %956, %959
  %961 = insertelement <16 x float> poison, float %952, i64 0
  %962 = shufflevector <16 x float> %961, <16 x float> poison, <16 x i32> zeroinitializer
  %963 = fmul contract <16 x float> %962, %928
  %964 = fadd contract <16 x float> %960, %963
  %965 = fmul contract <16 x float> %954, %932
  %966 = fadd contract <16 x float> %930, %965
  %967 = fmul contract <16 x float> %958, %934
  %968 = fadd contract <16 x float> %966, %967
  %969 = fmul contract <16 x float> %962, %936
  %970 = fadd contract <16 x float> %968, %969
  %971 = fmul contract <16 x float> %954, %940
  %972 = fadd contract <16 x float> %938, %971
  %973 = fmul contract <16 x float> %958, %942
  %974 = fadd contract <16 x float> %972, %973
  %975 = fmul contract <16 x float> %962, %944
  %976 = fadd contract <16 x float> %974, %975
  %977 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %946
  store <16 x float> %964, ptr %977, align 64
  %978 = getelementptr inbounds i8, ptr %977, i64 64
  store <16 x float> %970, ptr %978, align 64
  %979 = getelementptr inbounds i8, ptr %977, i64 128
  store <16 x float> %976, ptr %979, align 64
  %980 = add nsw i64 %946, 1
  %981 = icmp eq i64 %980, %918
  br i1 %981, label %982, label %945

982:
  %983 = phi i64 [ %906, %905 ], [ %914, %913 ], [ %914, %945 ]
  %984 = add nuw nsw i64 %907, 8
  %985 = icmp eq i64 %984, 16
  br i1 %985, label %899, label %905

986:
  %987 = phi <16 x i32> [ %1241, %1238 ], [ %754, %899 ]
  %988 = phi i64 [ %1242, %1238 ], [ %901, %899 ]
  %989 = phi i1 [ %1239, %1238 ], [ false, %899 ]
  %990 = phi i64 [ %1240, %1238 ], [ -1, %899 ]
  %991 = getelementptr inbounds %struct.PartPair, ptr %153, i64 %988
  %992 = load i64, ptr %991, align 8
  %993 = getelementptr inbounds %struct.Part, ptr %151, i64 %992
  %994 = getelementptr inbounds i8, ptr %991, i64 8
  %995 = load i64, ptr %994, align 8
  %996 = getelementptr inbounds %struct.Part, ptr %151, i64 %995
  %997 = icmp eq i64 %992, %990
  br i1 %997, label %1025, label %998

998:
  %999 = getelementptr inbounds i8, ptr %993, i64 28
  %1000 = load float, ptr %999, align 4
  %1001 = fadd contract float %827, %1000
  %1002 = insertelement <16 x float> poison, float %1001, i64 0
  %1003 = shufflevector <16 x float> %1002, <16 x float> poison, <16 x i32> zeroinitializer
  %1004 = fadd contract <16 x float> %771, %1003
  %1005 = fcmp contract ogt <16 x float> %1004, zeroinitializer
  %1006 = select contract <16 x i1> %1005, <16 x float> %1004, <16 x float> zeroinitializer
  %1007 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %992
  %1008 = load <16 x float>, ptr %1007, align 64
  %1009 = fsub contract <16 x float> %1008, %795
  %1010 = getelementptr inbounds i8, ptr %1007, i64 64
  %1011 = load <16 x float>, ptr %1010, align 64
  %1012 = fsub contract <16 x float> %1011, %809
  %1013 = getelementptr inbounds i8, ptr %1007, i64 128
  %1014 = load <16 x float>, ptr %1013, align 64
  %1015 = fsub contract <16 x float> %1014, %823
  %1016 = fmul contract <16 x float> %1009, %1009
  %1017 = fmul contract <16 x float> %1012, %1012
  %1018 = fadd contract <16 x float> %1016, %1017
  %1019 = fmul contract <16 x float> %1015, %1015
  %1020 = fadd contract <16 x float> %1018, %1019
  %1021 = fmul contract <16 x float> %1006, %1006
  %1022 = fcmp contract olt <16 x float> %1020, %1021
  %1023 = bitcast <16 x i1> %1022 to i16
  %1024 = icmp eq i16 %1023, 0
  br i1 %1024, label %1238, label %1026

1025:
  br i1 %989, label %1026, label %1238

1026:
  %1027 = phi i64 [ %992, %998 ], [ %990, %1025 ]
  %1028 = getelementptr inbounds i8, ptr %993, i64 28
  %1029 = load float, ptr %1028, align 4
  %1030 = getelementptr inbounds i8, ptr %996, i64 28
  %1031 = load float, ptr %1030, align 4
  %1032 = fadd contract float %1029, %1031
  %1033 = insertelement <16 x float> poison, float %1032, i64 0
  %1034 = shufflevector <16 x float> %1033, <16 x float> poison, <16 x i32> zeroinitializer
  %1035 = fadd contract <16 x float> %771, %1034
  %1036 = fcmp contract ogt <16 x float> %1035, zeroinitializer
  %1037 = select contract <16 x i1> %1036, <16 x float> %1035, <16 x float> zeroinitializer
  %1038 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %992
  %1039 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %995
  %1040 = load <16 x float>, ptr %1038, align 64
  %1041 = load <16 x float>, ptr %1039, align 64
  %1042 = fsub contract <16 x float> %1040, %1041
  %1043 = getelementptr inbounds i8, ptr %1038, i64 64
  %1044 = load <16 x float>, ptr %1043, align 64
  %1045 = getelementptr inbounds i8, ptr %1039, i64 64
  %1046 = load <16 x float>, ptr %1045, align 64
  %1047 = fsub contract <16 x float> %1044, %1046
  %1048 = getelementptr inbounds i8, ptr %1038, i64 128
  %1049 = load <16 x float>, ptr %1048, align 64
  %1050 = getelementptr inbounds i8, ptr %1039, i64 128
  %1051 = load <16 x float>, ptr %1050, align 64
  %1052 = fsub contract <16 x float> %1049, %1051
  %1053 = fmul contract <16 x float> %1042, %1042
  %1054 = fmul contract <16 x float> %1047, %1047
  %1055 = fadd contract <16 x float> %1053, %1054
  %1056 = fmul contract <16 x float> %1052, %1052
  %1057 = fadd contract <16 x float> %1055, %1056
  %1058 = fmul contract <16 x float> %1037, %1037
  %1059 = fcmp contract olt <16 x float> %1057, %1058
  %1060 = bitcast <16 x i1> %1059 to i16
  %1061 = icmp eq i16 %1060, 0
  br i1 %1061, label %1238, label %1062

1062:
  %1063 = getelementptr inbounds i8, ptr %993, i64 24
  %1064 = load float, ptr %1063, align 4
  %1065 = getelementptr inbounds i8, ptr %996, i64 24
  %1066 = load float, ptr %1065, align 4
  %1067 = fadd contract float %1064, %1066
  %1068 = insertelement <16 x float> poison, float %1067, i64 0
  %1069 = shufflevector <16 x float> %1068, <16 x float> poison, <16 x i32> zeroinitializer
  %1070 = fadd contract <16 x float> %771, %1069
  %1071 = fcmp contract ogt <16 x float> %1070, zeroinitializer
  %1072 = select contract <16 x i1> %1071, <16 x float> %1070, <16 x float> zeroinitializer
  %1073 = getelementptr inbounds i8, ptr %993, i64 12
  %1074 = load float, ptr %1073, align 4
  %1075 = fmul contract float %1074, %1074
  %1076 = getelementptr inbounds i8, ptr %993, i64 16
  %1077 = load float, ptr %1076, align 4
  %1078 = fmul contract float %1077, %1077
  %1079 = fadd contract float %1075, %1078
  %1080 = getelementptr inbounds i8, ptr %993, i64 20
  %1081 = load float, ptr %1080, align 4
  %1082 = fmul contract float %1081, %1081
  %1083 = fadd contract float %1079, %1082
  %1084 = getelementptr inbounds i8, ptr %996, i64 12
  %1085 = load float, ptr %1084, align 4
  %1086 = fmul contract float %1085, %1085
  %1087 = getelementptr inbounds i8, ptr %996, i64 16
  %1088 = load float, ptr %1087, align 4
  %1089 = fmul contract float %1088, %1088
  %1090 = fadd contract float %1086, %1089
  %1091 = getelementptr inbounds i8, ptr %996, i64 20
  %1092 = load float, ptr %1091, align 4
  %1093 = fmul contract float %1092, %1092
  %1094 = fadd contract float %1090, %1093
  %1095 = fcmp contract oeq float %1083, 0.000000e+00
  %1096 = fcmp contract oeq float %1094, 0.000000e+00
  %1097 = select i1 %1095, i1 %1096, i1 false
  br i1 %1097, label %1229, label %1098

1098:
  %1099 = fmul contract <16 x float> %1040, zeroinitializer
  %1100 = fadd contract <16 x float> %1099, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %1101 = insertelement <16 x float> poison, float %1074, i64 0
  %1102 = shufflevector <16 x float> %1101, <16 x float> poison, <16 x i32> zeroinitializer
  %1103 = fmul contract <16 x float> %841, %1102
  %1104 = insertelement <16 x float> poison, float %1077, i64 0
  %1105 = shufflevector <16 x float> %1104, <16 x float> poison, <16 x i32> zeroinitializer
  %1106 = fmul contract <16 x float> %847, %1105
  %1107 = fadd contract <16 x float> %1103, %1106
  %1108 = insertelement <16 x float> poison, float %1081, i64 0
  %1109 = shufflevector <16 x float> %1108, <16 x float> poison, <16 x i32> zeroinitializer
  %1110 = fmul contract <16 x float> %853, %1109
  %1111 = fadd contract <16 x float> %1107, %1110
  %1112 = fmul contract <16 x float> %861, %1102
  %1113 = fmul contract <16 x float> %865, %1105
  %1114 = fadd contract <16 x float> %1112, %1113
  %1115 = fmul contract <16 x float> %869, %1109
  %1116 = fadd contract <16 x float> %1114, %1115
  %1117 = fmul contract <16 x float> %875, %1102
  %1118 = fmul contract <16 x float> %879, %1105
  %1119 = fadd contract <16 x float> %1117, %1118
  %1120 = fmul contract <16 x float> %883, %1109
  %1121 = fadd contract <16 x float> %1119, %1120
  %1122 = insertelement <16 x float> poison, float %1085, i64 0
  %1123 = shufflevector <16 x float> %1122, <16 x float> poison, <16 x i32> zeroinitializer
  %1124 = fmul contract <16 x float> %779, %1123
  %1125 = insertelement <16 x float> poison, float %1088, i64 0
  %1126 = shufflevector <16 x float> %1125, <16 x float> poison, <16 x i32> zeroinitializer
  %1127 = fmul contract <16 x float> %785, %1126
  %1128 = fadd contract <16 x float> %1124, %1127
  %1129 = insertelement <16 x float> poison, float %1092, i64 0
  %1130 = shufflevector <16 x float> %1129, <16 x float> poison, <16 x i32> zeroinitializer
  %1131 = fmul contract <16 x float> %791, %1130
  %1132 = fadd contract <16 x float> %1128, %1131
  %1133 = fmul contract <16 x float> %799, %1123
  %1134 = fmul contract <16 x float> %803, %1126
  %1135 = fadd contract <16 x float> %1133, %1134
  %1136 = fmul contract <16 x float> %807, %1130
  %1137 = fadd contract <16 x float> %1135, %1136
  %1138 = fmul contract <16 x float> %813, %1123
  %1139 = fmul contract <16 x float> %817, %1126
  %1140 = fadd contract <16 x float> %1138, %1139
  %1141 = fmul contract <16 x float> %821, %1130
  %1142 = fadd contract <16 x float> %1140, %1141
  %1143 = fcmp contract ogt float %1083, 0.000000e+00
  %1144 = fdiv contract float 1.000000e+00, %1083
  %1145 = select contract i1 %1143, float %1144, float 0.000000e+00
  %1146 = fcmp contract ogt float %1094, 0.000000e+00
  %1147 = fdiv contract float 1.000000e+00, %1094
  %1148 = select contract i1 %1146, float %1147, float 0.000000e+00
  %1149 = fmul contract <16 x float> %1111, %1132
  %1150 = fmul contract <16 x float> %1116, %1137
  %1151 = fadd contract <16 x float> %1149, %1150
  %1152 = fmul contract <16 x float> %1121, %1142
  %1153 = fadd contract <16 x float> %1152, %1151
  %1154 = fmul contract <16 x float> %1042, %1111
  %1155 = fmul contract <16 x float> %1047, %1116
  %1156 = fadd contract <16 x float> %1154, %1155
  %1157 = fmul contract <16 x float> %1052, %1121
  %1158 = fadd contract <16 x float> %1157, %1156
  %1159 = fmul contract <16 x float> %1042, %1132
  %1160 = fmul contract <16 x float> %1047, %1137
  %1161 = fadd contract <16 x float> %1159, %1160
  %1162 = fmul contract <16 x float> %1052, %1142
  %1163 = fadd contract <16 x float> %1162, %1161
  %1164 = fmul contract float %1083, %1094
  %1165 = insertelement <16 x float> poison, float %1164, i64 0
  %1166 = shufflevector <16 x float> %1165, <16 x float> poison, <16 x i32> zeroinitializer
  %1167 = fmul contract <16 x float> %1153, %1153
  %1168 = fsub contract <16 x float> %1166, %1167
  %1169 = fmul contract float %1083, 0x3E7AD7F2A0000000
  %1170 = fmul contract float %1169, %1094
  %1171 = insertelement <16 x float> poison, float %1170, i64 0
  %1172 = shufflevector <16 x float> %1171, <16 x float> poison, <16 x i32> zeroinitializer
  %1173 = fcmp contract ogt <16 x float> %1168, %1172
  %1174 = fmul contract <16 x float> %1153, %1163
  %1175 = insertelement <16 x float> poison, float %1094, i64 0
  %1176 = shufflevector <16 x float> %1175, <16 x float> poison, <16 x i32> zeroinitializer
  %1177 = fmul contract <16 x float> %1176, %1158
  %1178 = fsub contract <16 x float> %1174, %1177
  %1179 = select contract <16 x i1> %1173, <16 x float> %1168, <16 x float> %1100
  %1180 = fdiv contract <16 x float> %1178, %1179
  %1181 = fneg contract <16 x float> %1100
  %1182 = fcmp contract ogt <16 x float> %1180, %1181
  %1183 = select contract <16 x i1> %1182, <16 x float> %1180, <16 x float> %1181
  %1184 = fcmp contract olt <16 x float> %1183, %1100
  %1185 = select contract <16 x i1> %1184, <16 x float> %1183, <16 x float> %1100
  %1186 = select contract <16 x i1> %1173, <16 x float> %1185, <16 x float> %1181
  %1187 = fmul contract <16 x float> %1153, %1186
  %1188 = fadd contract <16 x float> %1163, %1187
  %1189 = insertelement <16 x float> poison, float %1148, i64 0
  %1190 = shufflevector <16 x float> %1189, <16 x float> poison, <16 x i32> zeroinitializer
  %1191 = fmul contract <16 x float> %1190, %1188
  %1192 = fcmp contract ogt <16 x float> %1191, %1181
  %1193 = select contract <16 x i1> %1192, <16 x float> %1191, <16 x float> %1181
  %1194 = fcmp contract olt <16 x float> %1193, %1100
  %1195 = select contract <16 x i1> %1194, <16 x float> %1193, <16 x float> %1100
  %1196 = fmul contract <16 x float> %1153, %1195
  %1197 = fsub contract <16 x float> %1196, %1158
  %1198 = insertelement <16 x float> poison, float %1145, i64 0
  %1199 = shufflevector <16 x float> %1198, <16 x float> poison, <16 x i32> zeroinitializer
  %1200 = fmul contract <16 x float> %1199, %1197
  %1201 = fcmp contract ogt <16 x float> %1200, %1181
  %1202 = select contract <16 x i1> %1201, <16 x float> %1200, <16 x float> %1181
  %1203 = fcmp contract olt <16 x float> %1202, %1100
  %1204 = select contract <16 x i1> %1203, <16 x float> %1202, <16 x float> %1100
  %1205 = fmul contract <16 x float> %1153, %1204
  %1206 = fadd contract <16 x float> %1163, %1205
  %1207 = fmul contract <16 x float> %1190, %1206
  %1208 = fcmp contract ogt <16 x float> %1207, %1181
  %1209 = select contract <16 x i1> %1208, <16 x float> %1207, <16 x float> %1181
  %1210 = fcmp contract olt <16 x float> %1209, %1100
  %1211 = select contract <16 x i1> %1210, <16 x float> %1209, <16 x float> %1100
  %1212 = fmul contract <16 x float> %1111, %1204
  %1213 = fadd contract <16 x float> %1042, %1212
  %1214 = fmul contract <16 x float> %1132, %1211
  %1215 = fsub contract <16 x float> %1213, %1214
  %1216 = fmul contract <16 x float> %1116, %1204
  %1217 = fadd contract <16 x float> %1047, %1216
  %1218 = fmul contract <16 x float> %1137, %1211
  %1219 = fsub contract <16 x float> %1217, %1218
  %1220 = fmul contract <16 x float> %1121, %1204
  %1221 = fadd contract <16 x float> %1052, %1220
  %1222 = fmul contract <16 x float> %1142, %1211
  %1223 = fsub contract <16 x float> %1221, %1222
  %1224 = fmul contract <16 x float> %1215, %1215
  %1225 = fmul contract <16 x float> %1219, %1219
  %1226 = fadd contract <16 x float> %1224, %1225
  %1227 = fmul contract <16 x float> %1223, %1223
  %1228 = fadd contract <16 x float> %1227, %1226
  br label %1229

1229:
  %1230 = phi <16 x float> [ %1228, %1098 ], [ %1057, %1062 ]
  %1231 = fmul contract <16 x float> %1072, %1072
  %1232 = fcmp contract olt <16 x float> %1230, %1231
  %1233 = sext <16 x i1> %1232 to <16 x i32>
  %1234 = bitcast <16 x i1> %1232 to i16
  %1235 = icmp eq i16 %1234, 0
  br i1 %1235, label %1236, label %1251

1236:
  %1237 = or <16 x i32> %987, %1233
  br label %1238

1238:
  %1239 = phi i1 [ true, %1236 ], [ true, %1026 ], [ false, %1025 ], [ false, %998 ]
  %1240 = phi i64 [ %1027, %1236 ], [ %1027, %1026 ], [ %990, %1025 ], [ %992, %998 ]
  %1241 = phi <16 x i32> [ %1237, %1236 ], [ %987, %1026 ], [ %987, %1025 ], [ %987, %998 ]
  %1242 = add i64 %988, 1
  %1243 = icmp eq i64 %1242, %903
  br i1 %1243, label %1244, label %986

1244:
  %1245 = phi <16 x i32> [ %754, %899 ], [ %1241, %1238 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1246

1246:
  %1247 = phi <16 x i32> [ %1245, %1244 ], [ %754, %753 ]
  %1248 = phi i64 [ %983, %1244 ], [ %755, %753 ]
  %1249 = add nuw nsw i64 %756, 1
  %1250 = icmp eq i64 %1249, %23
  br i1 %1250, label %1252, label %753

1251:
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1252

1252:
  %1253 = phi <16 x i32> [ %1233, %1251 ], [ %752, %751 ], [ %1247, %1246 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %6)
  br label %1254

1254:
  %1255 = phi <16 x i32> [ %1253, %1252 ], [ %733, %729 ], [ %739, %737 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 8704, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 1088, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %9)
  %1256 = icmp ne <16 x i32> %1255, zeroinitializer
  %1257 = bitcast <16 x i1> %1256 to i16
  %1258 = icmp eq i16 %1257, 0
  br i1 %1258, label %163, label %1259

1259:
  %1260 = phi i1 [ true, %115 ], [ %165, %163 ], [ %168, %1254 ]
  call void @llvm.lifetime.end.p0(i64 1224, ptr nonnull %13)
  ret i1 %1260
}

declare void @llvm.lifetime.end.p0(i64 immarg, ptr nocapture)

define void @prove_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, double noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = alloca [192 x %struct.Point.7], align 64
  %9 = alloca [2 x i64], align 16
  %10 = alloca [9 x <8 x double>], align 64
  %11 = alloca [16 x <8 x double>], align 64
  %12 = alloca [17 x <8 x double>], align 64
  %13 = alloca [136 x <8 x double>], align 64
  %14 = alloca [17 x %struct.Frame.3], align 64
  %15 = alloca %struct.Motion.2, align 8
  %16 = alloca [4096 x %struct.Piece], align 16
  %17 = alloca [8 x %struct.Piece], align 16
  %18 = load i64, ptr %0, align 8
  %19 = icmp sgt i64 %4, 0
  br i1 %19, label %20, label %42

20:
  %21 = getelementptr inbounds i8, ptr %15, i64 272
  %22 = getelementptr inbounds i8, ptr %0, i64 112
  %23 = getelementptr inbounds i8, ptr %0, i64 16
  %24 = getelementptr inbounds i8, ptr %0, i64 120
  %25 = getelementptr inbounds i8, ptr %15, i64 136
  %26 = getelementptr inbounds i8, ptr %15, i64 1360
  %27 = getelementptr inbounds i8, ptr %14, i64 576
  %28 = getelementptr inbounds i8, ptr %0, i64 24
  %29 = getelementptr inbounds i8, ptr %0, i64 48
  %30 = getelementptr inbounds i8, ptr %0, i64 8
  %31 = getelementptr inbounds i8, ptr %0, i64 56
  %32 = getelementptr inbounds i8, ptr %0, i64 64
  %33 = getelementptr inbounds i8, ptr %0, i64 32
  %34 = getelementptr inbounds i8, ptr %0, i64 40
  %35 = getelementptr inbounds i8, ptr %0, i64 96
  %36 = getelementptr inbounds i8, ptr %0, i64 88
  %37 = getelementptr inbounds i8, ptr %0, i64 128
  %38 = getelementptr inbounds i8, ptr %9, i64 8
  %39 = getelementptr inbounds i8, ptr %0, i64 80
  %40 = getelementptr inbounds i8, ptr %0, i64 72
  %41 = getelementptr inbounds i8, ptr %0, i64 104
  br label %43

42:
  ret void

43:
  %44 = phi i64 [ 0, %20 ], [ %1363, %1360 ]
  %45 = mul nsw i64 %44, %18
  %46 = getelementptr inbounds double, ptr %1, i64 %45
  %47 = getelementptr inbounds double, ptr %2, i64 %45
  %48 = getelementptr inbounds double, ptr %3, i64 %45
  call void @llvm.lifetime.start.p0(i64 2448, ptr nonnull %15)
  %49 = load i64, ptr %0, align 8
  %50 = icmp slt i64 %49, 0
  br i1 %50, label %54, label %51

51:
  %52 = icmp eq i64 %49, 0
  %53 = load ptr, ptr %22, align 8
  br label %60

54:
  %55 = load i64, ptr %23, align 8
  %56 = icmp sgt i64 %55, 0
  br i1 %56, label %57, label %106

57:
  %58 = icmp sgt i64 %49, 0
  %59 = load ptr, ptr %24, align 8
  br label %83

60:
  %61 = phi i64 [ 0, %51 ], [ %81, %78 ]
  %62 = mul nuw nsw i64 %61, %49
  %63 = getelementptr inbounds double, ptr %53, i64 %62
  br i1 %52, label %78, label %64

64:
  %65 = phi i64 [ %76, %64 ], [ 0, %60 ]
  %66 = phi double [ %75, %64 ], [ 0.000000e+00, %60 ]
  %67 = getelementptr inbounds double, ptr %63, i64 %65
  %68 = load double, ptr %67, align 8
  %69 = getelementptr inbounds double, ptr %47, i64 %65
  %70 = load double, ptr %69, align 8
  %71 = fcmp contract olt double %70, 0.000000e+00
  %72 = fneg contract double %70
  %73 = select contract i1 %71, double %72, double %70
  %74 = fmul contract double %68, %73
  %75 = fadd contract double %66, %74
  %76 = add nuw nsw i64 %65, 1
  %77 = icmp eq i64 %76, %49
  br i1 %77, label %78, label %64

78:
  %79 = phi double [ 0.000000e+00, %60 ], [ %75, %64 ]
  %80 = getelementptr inbounds double, ptr %15, i64 %61
  store double %79, ptr %80, align 8
  %81 = add nuw i64 %61, 1
  %82 = icmp eq i64 %61, %49
  br i1 %82, label %54, label %60

83:
  %84 = phi i64 [ 0, %57 ], [ %104, %101 ]
  %85 = mul nsw i64 %84, %49
  %86 = getelementptr inbounds double, ptr %59, i64 %85
  br i1 %58, label %87, label %101

87:
  %88 = phi i64 [ %99, %87 ], [ 0, %83 ]
  %89 = phi double [ %98, %87 ], [ 0.000000e+00, %83 ]
  %90 = getelementptr inbounds double, ptr %86, i64 %88
  %91 = load double, ptr %90, align 8
  %92 = getelementptr inbounds double, ptr %47, i64 %88
  %93 = load double, ptr %92, align 8
  %94 = fcmp contract olt double %93, 0.000000e+00
  %95 = fneg contract double %93
  %96 = select contract i1 %94, double %95, double %93
  %97 = fmul contract double %91, %96
  %98 = fadd contract double %89, %97
  %99 = add nuw nsw i64 %88, 1
  %100 = icmp eq i64 %99, %49
  br i1 %100, label %101, label %87

101:
  %102 = phi double [ 0.000000e+00, %83 ], [ %98, %87 ]
  %103 = getelementptr inbounds double, ptr %21, i64 %84
  store double %102, ptr %103, align 8
  %104 = add nuw nsw i64 %84, 1
  %105 = icmp eq i64 %104, %55
  br i1 %105, label %106, label %83

106:
  br i1 %50, label %110, label %107

107:
  %108 = icmp eq i64 %49, 0
  %109 = load ptr, ptr %22, align 8
  br label %114

110:
  br i1 %56, label %111, label %160

111:
  %112 = icmp sgt i64 %49, 0
  %113 = load ptr, ptr %24, align 8
  br label %137

114:
  %115 = phi i64 [ 0, %107 ], [ %135, %132 ]
  %116 = mul nuw nsw i64 %115, %49
  %117 = getelementptr inbounds double, ptr %109, i64 %116
  br i1 %108, label %132, label %118

118:
  %119 = phi i64 [ %130, %118 ], [ 0, %114 ]
  %120 = phi double [ %129, %118 ], [ 0.000000e+00, %114 ]
  %121 = getelementptr inbounds double, ptr %117, i64 %119
  %122 = load double, ptr %121, align 8
  %123 = getelementptr inbounds double, ptr %48, i64 %119
  %124 = load double, ptr %123, align 8
  %125 = fcmp contract olt double %124, 0.000000e+00
  %126 = fneg contract double %124
  %127 = select contract i1 %125, double %126, double %124
  %128 = fmul contract double %122, %127
  %129 = fadd contract double %120, %128
  %130 = add nuw nsw i64 %119, 1
  %131 = icmp eq i64 %130, %49
  br i1 %131, label %132, label %118

132:
  %133 = phi double [ 0.000000e+00, %114 ], [ %129, %118 ]
  %134 = getelementptr inbounds double, ptr %25, i64 %115
  store double %133, ptr %134, align 8
  %135 = add nuw i64 %115, 1
  %136 = icmp eq i64 %115, %49
  br i1 %136, label %110, label %114

137:
  %138 = phi i64 [ 0, %111 ], [ %158, %155 ]
  %139 = mul nsw i64 %138, %49
  %140 = getelementptr inbounds double, ptr %113, i64 %139
  br i1 %112, label %141, label %155

141:
  %142 = phi i64 [ %153, %141 ], [ 0, %137 ]
  %143 = phi double [ %152, %141 ], [ 0.000000e+00, %137 ]
  %144 = getelementptr inbounds double, ptr %140, i64 %142
  %145 = load double, ptr %144, align 8
  %146 = getelementptr inbounds double, ptr %48, i64 %142
  %147 = load double, ptr %146, align 8
  %148 = fcmp contract olt double %147, 0.000000e+00
  %149 = fneg contract double %147
  %150 = select contract i1 %148, double %149, double %147
  %151 = fmul contract double %145, %150
  %152 = fadd contract double %143, %151
  %153 = add nuw nsw i64 %142, 1
  %154 = icmp eq i64 %153, %49
  br i1 %154, label %155, label %141

155:
  %156 = phi double [ 0.000000e+00, %137 ], [ %152, %141 ]
  %157 = getelementptr inbounds double, ptr %26, i64 %138
  store double %156, ptr %157, align 8
  %158 = add nuw nsw i64 %138, 1
  %159 = icmp eq i64 %158, %55
  br i1 %159, label %160, label %137

160:
  br i1 %50, label %161, label %163

161:
  %162 = phi double [ 0.000000e+00, %160 ], [ %169, %163 ]
  br i1 %56, label %172, label %181

163:
  %164 = phi i64 [ %170, %163 ], [ 0, %160 ]
  %165 = phi double [ %169, %163 ], [ 0.000000e+00, %160 ]
  %166 = getelementptr inbounds [17 x double], ptr %15, i64 0, i64 %164
  %167 = load double, ptr %166, align 8
  %168 = fcmp contract ogt double %167, %165
  %169 = select i1 %168, double %167, double %165
  %170 = add nuw i64 %164, 1
  %171 = icmp eq i64 %164, %49
  br i1 %171, label %161, label %163

172:
  %173 = phi i64 [ %179, %172 ], [ 0, %161 ]
  %174 = phi double [ %178, %172 ], [ %162, %161 ]
  %175 = getelementptr inbounds [136 x double], ptr %21, i64 0, i64 %173
  %176 = load double, ptr %175, align 8
  %177 = fcmp contract ogt double %176, %174
  %178 = select i1 %177, double %176, double %174
  %179 = add nuw nsw i64 %173, 1
  %180 = icmp eq i64 %179, %55
  br i1 %180, label %181, label %172

181:
  %182 = phi double [ %162, %161 ], [ %178, %172 ]
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %16)
  br label %200

183:
  %184 = icmp sgt i64 %49, 0
  %185 = icmp slt i64 %49, 1
  %186 = load ptr, ptr %28, align 8
  %187 = load ptr, ptr %29, align 8
  %188 = load i64, ptr %30, align 8
  %189 = icmp sgt i64 %188, 0
  %190 = load ptr, ptr %31, align 8
  %191 = load ptr, ptr %32, align 8
  %192 = load ptr, ptr %33, align 8
  %193 = load ptr, ptr %34, align 8
  %194 = load ptr, ptr %35, align 8
  %195 = load ptr, ptr %36, align 8
  %196 = load ptr, ptr %37, align 8
  %197 = load ptr, ptr %39, align 8
  %198 = load ptr, ptr %40, align 8
  %199 = load ptr, ptr %41, align 8
  br label %210

200:
  %201 = phi i64 [ 0, %181 ], [ %206, %200 ]
  %202 = uitofp nneg i64 %201 to double
  %203 = fmul contract double %202, 2.000000e+00
  %204 = fadd contract double %203, 1.000000e+00
  %205 = fmul contract double %204, 6.250000e-02
  %206 = add nuw nsw i64 %201, 1
  %207 = getelementptr inbounds [4096 x %struct.Piece], ptr %16, i64 0, i64 %201
  store double %205, ptr %207, align 16
  %208 = getelementptr inbounds i8, ptr %207, i64 8
  store double 6.250000e-02, ptr %208, align 8
  %209 = icmp eq i64 %206, 8
  br i1 %209, label %183, label %200

210:
  %211 = phi i64 [ 8, %183 ], [ %1358, %1357 ]
  %212 = phi <8 x double> [ undef, %183 ], [ %1321, %1357 ]
  %213 = phi <8 x double> [ undef, %183 ], [ %1324, %1357 ]
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %17)
  br label %1310

214:
  %215 = tail call i64 @llvm.smin.i64(i64 %211, i64 8)
  %216 = sub nsw i64 %211, %215
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 1088, ptr nonnull %12)
  call void @llvm.lifetime.start.p0(i64 8704, ptr nonnull %13)
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %14)
  br i1 %184, label %438, label %217

217:
  br label %218

218:
  %219 = phi i64 [ %226, %218 ], [ 0, %217 ]
  %220 = and i64 %219, 3
  %221 = icmp eq i64 %220, 0
  %222 = uitofp i1 %221 to double
  %223 = insertelement <8 x double> poison, double %222, i64 0
  %224 = shufflevector <8 x double> %223, <8 x double> poison, <8 x i32> zeroinitializer
  %225 = getelementptr inbounds [9 x <8 x double>], ptr %14, i64 0, i64 %219
  store <8 x double> %224, ptr %225, align 64
  %226 = add nuw nsw i64 %219, 1
  %227 = icmp eq i64 %226, 9
  br i1 %227, label %229, label %218

228:
  br i1 %184, label %234, label %453

229:
  %230 = phi i64 [ %232, %229 ], [ 0, %218 ]
  %231 = getelementptr inbounds [3 x <8 x double>], ptr %27, i64 0, i64 %230
  store <8 x double> zeroinitializer, ptr %231, align 64
  %232 = add nuw nsw i64 %230, 1
  %233 = icmp eq i64 %232, 3
  br i1 %233, label %228, label %229

234:
  %235 = phi i64 [ %287, %436 ], [ 0, %228 ]
  %236 = getelementptr inbounds %struct.Joint.6, ptr %186, i64 %235
  %237 = getelementptr inbounds %struct.Frame.3, ptr %14, i64 %235
  %238 = getelementptr inbounds <8 x double>, ptr %11, i64 %235
  %239 = load <8 x double>, ptr %238, align 64
  %240 = getelementptr inbounds i8, ptr %236, i64 72
  %241 = load double, ptr %240, align 8
  %242 = getelementptr inbounds i8, ptr %236, i64 80
  %243 = load double, ptr %242, align 8
  %244 = getelementptr inbounds i8, ptr %236, i64 88
  %245 = load double, ptr %244, align 8
  %246 = getelementptr inbounds i8, ptr %237, i64 576
  %247 = load <8 x double>, ptr %246, align 64
  %248 = load <8 x double>, ptr %237, align 64
  %249 = insertelement <8 x double> poison, double %241, i64 0
  %250 = shufflevector <8 x double> %249, <8 x double> poison, <8 x i32> zeroinitializer
  %251 = getelementptr inbounds i8, ptr %237, i64 64
  %252 = load <8 x double>, ptr %251, align 64
  %253 = insertelement <8 x double> poison, double %243, i64 0
  %254 = shufflevector <8 x double> %253, <8 x double> poison, <8 x i32> zeroinitializer
  %255 = getelementptr inbounds i8, ptr %237, i64 128
  %256 = load <8 x double>, ptr %255, align 64
  %257 = insertelement <8 x double> poison, double %245, i64 0
  %258 = shufflevector <8 x double> %257, <8 x double> poison, <8 x i32> zeroinitializer
  %259 = getelementptr inbounds i8, ptr %237, i64 640
  %260 = load <8 x double>, ptr %259, align 64
  %261 = getelementptr inbounds i8, ptr %237, i64 192
  %262 = load <8 x double>, ptr %261, align 64
  %263 = getelementptr inbounds i8, ptr %237, i64 256
  %264 = load <8 x double>, ptr %263, align 64
  %265 = getelementptr inbounds i8, ptr %237, i64 320
  %266 = load <8 x double>, ptr %265, align 64
  %267 = getelementptr inbounds i8, ptr %237, i64 704
  %268 = load <8 x double>, ptr %267, align 64
  %269 = getelementptr inbounds i8, ptr %237, i64 384
  %270 = load <8 x double>, ptr %269, align 64
  %271 = getelementptr inbounds i8, ptr %237, i64 448
  %272 = load <8 x double>, ptr %271, align 64
  %273 = getelementptr inbounds i8, ptr %237, i64 512
  %274 = load <8 x double>, ptr %273, align 64
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %10)
  br label %275

275:
  %276 = phi i64 [ 0, %234 ], [ %314, %313 ]
  %277 = mul nuw nsw i64 %276, 3
  %278 = getelementptr inbounds [9 x <8 x double>], ptr %237, i64 0, i64 %277
  %279 = load <8 x double>, ptr %278, align 64
  %280 = add nuw nsw i64 %277, 1
  %281 = getelementptr inbounds [9 x <8 x double>], ptr %237, i64 0, i64 %280
  %282 = load <8 x double>, ptr %281, align 64
  %283 = add nuw nsw i64 %277, 2
  %284 = getelementptr inbounds [9 x <8 x double>], ptr %237, i64 0, i64 %283
  %285 = load <8 x double>, ptr %284, align 64
  br label %316

286:
  %287 = add nuw nsw i64 %235, 1
  %288 = fmul contract <8 x double> %250, %248
  %289 = fmul contract <8 x double> %254, %252
  %290 = fmul contract <8 x double> %258, %256
  %291 = fmul contract <8 x double> %250, %262
  %292 = fmul contract <8 x double> %254, %264
  %293 = fmul contract <8 x double> %258, %266
  %294 = fmul contract <8 x double> %250, %270
  %295 = fmul contract <8 x double> %254, %272
  %296 = fmul contract <8 x double> %258, %274
  %297 = getelementptr inbounds %struct.Frame.3, ptr %14, i64 %287
  %298 = fadd contract <8 x double> %247, %288
  %299 = fadd contract <8 x double> %298, %289
  %300 = fadd contract <8 x double> %299, %290
  %301 = fadd contract <8 x double> %260, %291
  %302 = fadd contract <8 x double> %301, %292
  %303 = fadd contract <8 x double> %302, %293
  %304 = fadd contract <8 x double> %268, %294
  %305 = fadd contract <8 x double> %304, %295
  %306 = fadd contract <8 x double> %305, %296
  %307 = getelementptr inbounds i8, ptr %297, i64 576
  store <8 x double> %300, ptr %307, align 64
  %308 = getelementptr inbounds i8, ptr %297, i64 640
  store <8 x double> %303, ptr %308, align 64
  %309 = getelementptr inbounds i8, ptr %297, i64 704
  store <8 x double> %306, ptr %309, align 64
  %310 = getelementptr inbounds i8, ptr %236, i64 96
  %311 = load double, ptr %310, align 8
  %312 = fcmp contract une double %311, 0.000000e+00
  br i1 %312, label %341, label %360

313:
  %314 = add nuw nsw i64 %276, 1
  %315 = icmp eq i64 %314, 3
  br i1 %315, label %286, label %275

316:
  %317 = phi i64 [ 0, %275 ], [ %339, %316 ]
  %318 = getelementptr inbounds [9 x double], ptr %236, i64 0, i64 %317
  %319 = load double, ptr %318, align 8
  %320 = insertelement <8 x double> poison, double %319, i64 0
  %321 = shufflevector <8 x double> %320, <8 x double> poison, <8 x i32> zeroinitializer
  %322 = fmul contract <8 x double> %279, %321
  %323 = add nuw nsw i64 %317, 3
  %324 = getelementptr inbounds [9 x double], ptr %236, i64 0, i64 %323
  %325 = load double, ptr %324, align 8
  %326 = insertelement <8 x double> poison, double %325, i64 0
  %327 = shufflevector <8 x double> %326, <8 x double> poison, <8 x i32> zeroinitializer
  %328 = fmul contract <8 x double> %282, %327
  %329 = fadd contract <8 x double> %322, %328
  %330 = add nuw nsw i64 %317, 6
  %331 = getelementptr inbounds [9 x double], ptr %236, i64 0, i64 %330
  %332 = load double, ptr %331, align 8
  %333 = insertelement <8 x double> poison, double %332, i64 0
  %334 = shufflevector <8 x double> %333, <8 x double> poison, <8 x i32> zeroinitializer
  %335 = fmul contract <8 x double> %285, %334
  %336 = fadd contract <8 x double> %329, %335
  %337 = add nuw nsw i64 %317, %277
  %338 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %337
  store <8 x double> %336, ptr %338, align 64
  %339 = add nuw nsw i64 %317, 1
  %340 = icmp eq i64 %339, 3
  br i1 %340, label %313, label %316

341:
  %342 = phi i64 [ %346, %341 ], [ 0, %286 ]
  %343 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %342
  %344 = load <8 x double>, ptr %343, align 64
  %345 = getelementptr inbounds [9 x <8 x double>], ptr %297, i64 0, i64 %342
  store <8 x double> %344, ptr %345, align 64
  %346 = add nuw nsw i64 %342, 1
  %347 = icmp eq i64 %346, 9
  br i1 %347, label %348, label %341

348:
  %349 = phi i64 [ %358, %348 ], [ 0, %341 ]
  %350 = mul nuw nsw i64 %349, 3
  %351 = add nuw nsw i64 %350, 2
  %352 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %351
  %353 = load <8 x double>, ptr %352, align 64
  %354 = fmul contract <8 x double> %239, %353
  %355 = getelementptr inbounds [3 x <8 x double>], ptr %307, i64 0, i64 %349
  %356 = load <8 x double>, ptr %355, align 64
  %357 = fadd contract <8 x double> %356, %354
  store <8 x double> %357, ptr %355, align 64
  %358 = add nuw nsw i64 %349, 1
  %359 = icmp eq i64 %358, 3
  br i1 %359, label %436, label %348

360:
  %361 = fmul contract <8 x double> %239, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %362 = fadd contract <8 x double> %361, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %363 = fadd contract <8 x double> %362, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %364 = fmul contract <8 x double> %363, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %365 = fsub contract <8 x double> %239, %364
  %366 = fmul contract <8 x double> %363, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %367 = fsub contract <8 x double> %365, %366
  %368 = fmul contract <8 x double> %363, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %369 = fsub contract <8 x double> %367, %368
  %370 = fmul contract <8 x double> %363, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %371 = fadd contract <8 x double> %370, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %372 = fadd contract <8 x double> %371, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %373 = fsub contract <8 x double> %370, %372
  %374 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %373)
  %375 = fmul contract <8 x double> %374, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %376 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %375
  %377 = fmul contract <8 x double> %369, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %378 = fmul contract <8 x double> %377, %377
  %379 = fmul contract <8 x double> %377, %378
  %380 = fmul contract <8 x double> %378, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %381 = fadd contract <8 x double> %380, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %382 = fmul contract <8 x double> %378, %381
  %383 = fadd contract <8 x double> %382, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %384 = fmul contract <8 x double> %378, %383
  %385 = fadd contract <8 x double> %384, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %386 = fmul contract <8 x double> %378, %385
  %387 = fadd contract <8 x double> %386, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %388 = fmul contract <8 x double> %378, %387
  %389 = fadd contract <8 x double> %388, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %390 = fmul contract <8 x double> %379, %389
  %391 = fadd contract <8 x double> %377, %390
  %392 = fmul contract <8 x double> %378, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %393 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %392
  %394 = fmul contract <8 x double> %378, %378
  %395 = fmul contract <8 x double> %378, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %396 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %395
  %397 = fmul contract <8 x double> %378, %396
  %398 = fadd contract <8 x double> %397, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %399 = fmul contract <8 x double> %378, %398
  %400 = fadd contract <8 x double> %399, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %401 = fmul contract <8 x double> %378, %400
  %402 = fadd contract <8 x double> %401, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %403 = fmul contract <8 x double> %378, %402
  %404 = fadd contract <8 x double> %403, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %405 = fmul contract <8 x double> %394, %404
  %406 = fadd contract <8 x double> %393, %405
  %407 = fmul contract <8 x double> %376, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %408 = fmul contract <8 x double> %407, %391
  %409 = fmul contract <8 x double> %406, %408
  %410 = fmul contract <8 x double> %391, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %411 = fmul contract <8 x double> %391, %410
  %412 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %411
  %413 = fmul contract <8 x double> %376, %412
  br label %414

414:
  %415 = phi i64 [ 0, %360 ], [ %434, %414 ]
  %416 = mul nuw nsw i64 %415, 3
  %417 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %416
  %418 = load <8 x double>, ptr %417, align 64
  %419 = fmul contract <8 x double> %413, %418
  %420 = add nuw nsw i64 %416, 1
  %421 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %420
  %422 = load <8 x double>, ptr %421, align 64
  %423 = fmul contract <8 x double> %409, %422
  %424 = fadd contract <8 x double> %419, %423
  %425 = getelementptr inbounds [9 x <8 x double>], ptr %297, i64 0, i64 %416
  store <8 x double> %424, ptr %425, align 64
  %426 = fmul contract <8 x double> %413, %422
  %427 = fmul contract <8 x double> %409, %418
  %428 = fsub contract <8 x double> %426, %427
  %429 = getelementptr inbounds [9 x <8 x double>], ptr %297, i64 0, i64 %420
  store <8 x double> %428, ptr %429, align 64
  %430 = add nuw nsw i64 %416, 2
  %431 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %430
  %432 = load <8 x double>, ptr %431, align 64
  %433 = getelementptr inbounds [9 x <8 x double>], ptr %297, i64 0, i64 %430
  store <8 x double> %432, ptr %433, align 64
  %434 = add nuw nsw i64 %415, 1
  %435 = icmp eq i64 %434, 3
  br i1 %435, label %436, label %414

436:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %10)
  %437 = icmp eq i64 %287, %49
  br i1 %437, label %454, label %234

438:
  %439 = phi i64 [ %451, %438 ], [ 0, %214 ]
  %440 = getelementptr inbounds double, ptr %46, i64 %439
  %441 = load double, ptr %440, align 8
  %442 = insertelement <8 x double> poison, double %441, i64 0
  %443 = shufflevector <8 x double> %442, <8 x double> poison, <8 x i32> zeroinitializer
  %444 = getelementptr inbounds double, ptr %47, i64 %439
  %445 = load double, ptr %444, align 8
  %446 = insertelement <8 x double> poison, double %445, i64 0
  %447 = shufflevector <8 x double> %446, <8 x double> poison, <8 x i32> zeroinitializer
  %448 = fmul contract <8 x double> %1321, %447
  %449 = fadd contract <8 x double> %443, %448
  %450 = getelementptr inbounds [16 x <8 x double>], ptr %11, i64 0, i64 %439
  store <8 x double> %449, ptr %450, align 64
  %451 = add nuw nsw i64 %439, 1
  %452 = icmp eq i64 %451, %49
  br i1 %452, label %217, label %438

453:
  br i1 %56, label %470, label %469

454:
  %455 = phi i64 [ %467, %454 ], [ 1, %436 ]
  %456 = getelementptr inbounds [17 x double], ptr %15, i64 0, i64 %455
  %457 = load double, ptr %456, align 8
  %458 = insertelement <8 x double> poison, double %457, i64 0
  %459 = shufflevector <8 x double> %458, <8 x double> poison, <8 x i32> zeroinitializer
  %460 = fmul contract <8 x double> %1324, %459
  %461 = getelementptr inbounds [17 x double], ptr %25, i64 0, i64 %455
  %462 = load double, ptr %461, align 8
  %463 = insertelement <8 x double> poison, double %462, i64 0
  %464 = shufflevector <8 x double> %463, <8 x double> poison, <8 x i32> zeroinitializer
  %465 = fadd contract <8 x double> %460, %464
  %466 = getelementptr inbounds [17 x <8 x double>], ptr %12, i64 0, i64 %455
  store <8 x double> %465, ptr %466, align 64
  %467 = add nuw i64 %455, 1
  %468 = icmp eq i64 %455, %49
  br i1 %468, label %453, label %454

469:
  br i1 %185, label %804, label %485

470:
  %471 = phi i64 [ %483, %470 ], [ 0, %453 ]
  %472 = getelementptr inbounds [136 x double], ptr %21, i64 0, i64 %471
  %473 = load double, ptr %472, align 8
  %474 = insertelement <8 x double> poison, double %473, i64 0
  %475 = shufflevector <8 x double> %474, <8 x double> poison, <8 x i32> zeroinitializer
  %476 = fmul contract <8 x double> %1324, %475
  %477 = getelementptr inbounds [136 x double], ptr %26, i64 0, i64 %471
  %478 = load double, ptr %477, align 8
  %479 = insertelement <8 x double> poison, double %478, i64 0
  %480 = shufflevector <8 x double> %479, <8 x double> poison, <8 x i32> zeroinitializer
  %481 = fadd contract <8 x double> %476, %480
  %482 = getelementptr inbounds [136 x <8 x double>], ptr %13, i64 0, i64 %471
  store <8 x double> %481, ptr %482, align 64
  %483 = add nuw nsw i64 %471, 1
  %484 = icmp eq i64 %483, %55
  br i1 %484, label %469, label %470

485:
  %486 = phi <8 x i64> [ %801, %800 ], [ zeroinitializer, %469 ]
  %487 = phi i64 [ %802, %800 ], [ 1, %469 ]
  %488 = getelementptr inbounds %struct.Sphere.8, ptr %187, i64 %487
  %489 = getelementptr inbounds i8, ptr %488, i64 24
  %490 = load double, ptr %489, align 8
  %491 = fcmp contract olt double %490, 0.000000e+00
  br i1 %491, label %800, label %492

492:
  %493 = getelementptr inbounds %struct.Frame.3, ptr %14, i64 %487
  %494 = load double, ptr %488, align 8
  %495 = getelementptr inbounds i8, ptr %488, i64 8
  %496 = load double, ptr %495, align 8
  %497 = getelementptr inbounds i8, ptr %488, i64 16
  %498 = load double, ptr %497, align 8
  %499 = getelementptr inbounds i8, ptr %493, i64 576
  %500 = load <8 x double>, ptr %499, align 64
  %501 = load <8 x double>, ptr %493, align 64
  %502 = insertelement <8 x double> poison, double %494, i64 0
  %503 = shufflevector <8 x double> %502, <8 x double> poison, <8 x i32> zeroinitializer
  %504 = fmul contract <8 x double> %503, %501
  %505 = fadd contract <8 x double> %500, %504
  %506 = getelementptr inbounds i8, ptr %493, i64 64
  %507 = load <8 x double>, ptr %506, align 64
  %508 = insertelement <8 x double> poison, double %496, i64 0
  %509 = shufflevector <8 x double> %508, <8 x double> poison, <8 x i32> zeroinitializer
  %510 = fmul contract <8 x double> %509, %507
  %511 = fadd contract <8 x double> %505, %510
  %512 = getelementptr inbounds i8, ptr %493, i64 128
  %513 = load <8 x double>, ptr %512, align 64
  %514 = insertelement <8 x double> poison, double %498, i64 0
  %515 = shufflevector <8 x double> %514, <8 x double> poison, <8 x i32> zeroinitializer
  %516 = fmul contract <8 x double> %515, %513
  %517 = fadd contract <8 x double> %511, %516
  %518 = getelementptr inbounds i8, ptr %493, i64 640
  %519 = load <8 x double>, ptr %518, align 64
  %520 = getelementptr inbounds i8, ptr %493, i64 192
  %521 = load <8 x double>, ptr %520, align 64
  %522 = fmul contract <8 x double> %503, %521
  %523 = fadd contract <8 x double> %519, %522
  %524 = getelementptr inbounds i8, ptr %493, i64 256
  %525 = load <8 x double>, ptr %524, align 64
  %526 = fmul contract <8 x double> %509, %525
  %527 = fadd contract <8 x double> %523, %526
  %528 = getelementptr inbounds i8, ptr %493, i64 320
  %529 = load <8 x double>, ptr %528, align 64
  %530 = fmul contract <8 x double> %515, %529
  %531 = fadd contract <8 x double> %527, %530
  %532 = getelementptr inbounds i8, ptr %493, i64 704
  %533 = load <8 x double>, ptr %532, align 64
  %534 = getelementptr inbounds i8, ptr %493, i64 384
  %535 = load <8 x double>, ptr %534, align 64
  %536 = fmul contract <8 x double> %503, %535
  %537 = fadd contract <8 x double> %533, %536
  %538 = getelementptr inbounds i8, ptr %493, i64 448
  %539 = load <8 x double>, ptr %538, align 64
  %540 = fmul contract <8 x double> %509, %539
  %541 = fadd contract <8 x double> %537, %540
  %542 = getelementptr inbounds i8, ptr %493, i64 512
  %543 = load <8 x double>, ptr %542, align 64
  %544 = fmul contract <8 x double> %515, %543
  %545 = fadd contract <8 x double> %541, %544
  %546 = getelementptr inbounds <8 x double>, ptr %12, i64 %487
  %547 = load <8 x double>, ptr %546, align 64
  br i1 %189, label %548, label %800

548:
  %549 = mul nuw nsw i64 %487, %188
  %550 = getelementptr double, ptr %191, i64 %549
  %551 = getelementptr inbounds i64, ptr %192, i64 %487
  %552 = getelementptr inbounds i8, ptr %551, i64 8
  br label %553

553:
  %554 = phi <8 x i64> [ %486, %548 ], [ %797, %796 ]
  %555 = phi i64 [ 0, %548 ], [ %798, %796 ]
  %556 = getelementptr inbounds %struct.Object.9, ptr %190, i64 %555
  %557 = getelementptr double, ptr %550, i64 %555
  %558 = load double, ptr %557, align 8
  %559 = getelementptr inbounds i8, ptr %556, i64 120
  %560 = load double, ptr %559, align 8
  %561 = fadd contract double %558, %560
  %562 = fcmp contract olt double %561, -1.000000e+08
  br i1 %562, label %796, label %563

563:
  %564 = fadd contract double %490, %561
  %565 = insertelement <8 x double> poison, double %564, i64 0
  %566 = shufflevector <8 x double> %565, <8 x double> poison, <8 x i32> zeroinitializer
  %567 = fadd contract <8 x double> %547, %566
  %568 = fcmp contract ogt <8 x double> %567, zeroinitializer
  %569 = select contract <8 x i1> %568, <8 x double> %567, <8 x double> zeroinitializer
  %570 = getelementptr inbounds i8, ptr %556, i64 72
  %571 = load double, ptr %570, align 8
  %572 = insertelement <8 x double> poison, double %571, i64 0
  %573 = shufflevector <8 x double> %572, <8 x double> poison, <8 x i32> zeroinitializer
  %574 = load double, ptr %556, align 8
  %575 = insertelement <8 x double> poison, double %574, i64 0
  %576 = shufflevector <8 x double> %575, <8 x double> poison, <8 x i32> zeroinitializer
  %577 = fmul contract <8 x double> %517, %576
  %578 = fadd contract <8 x double> %573, %577
  %579 = getelementptr inbounds i8, ptr %556, i64 8
  %580 = load double, ptr %579, align 8
  %581 = insertelement <8 x double> poison, double %580, i64 0
  %582 = shufflevector <8 x double> %581, <8 x double> poison, <8 x i32> zeroinitializer
  %583 = fmul contract <8 x double> %531, %582
  %584 = fadd contract <8 x double> %578, %583
  %585 = getelementptr inbounds i8, ptr %556, i64 16
  %586 = load double, ptr %585, align 8
  %587 = insertelement <8 x double> poison, double %586, i64 0
  %588 = shufflevector <8 x double> %587, <8 x double> poison, <8 x i32> zeroinitializer
  %589 = fmul contract <8 x double> %545, %588
  %590 = fadd contract <8 x double> %584, %589
  %591 = getelementptr inbounds i8, ptr %556, i64 80
  %592 = load double, ptr %591, align 8
  %593 = insertelement <8 x double> poison, double %592, i64 0
  %594 = shufflevector <8 x double> %593, <8 x double> poison, <8 x i32> zeroinitializer
  %595 = getelementptr inbounds i8, ptr %556, i64 24
  %596 = load double, ptr %595, align 8
  %597 = insertelement <8 x double> poison, double %596, i64 0
  %598 = shufflevector <8 x double> %597, <8 x double> poison, <8 x i32> zeroinitializer
  %599 = fmul contract <8 x double> %517, %598
  %600 = fadd contract <8 x double> %594, %599
  %601 = getelementptr inbounds i8, ptr %556, i64 32
  %602 = load double, ptr %601, align 8
  %603 = insertelement <8 x double> poison, double %602, i64 0
  %604 = shufflevector <8 x double> %603, <8 x double> poison, <8 x i32> zeroinitializer
  %605 = fmul contract <8 x double> %531, %604
  %606 = fadd contract <8 x double> %600, %605
  %607 = getelementptr inbounds i8, ptr %556, i64 40
  %608 = load double, ptr %607, align 8
  %609 = insertelement <8 x double> poison, double %608, i64 0
  %610 = shufflevector <8 x double> %609, <8 x double> poison, <8 x i32> zeroinitializer
  %611 = fmul contract <8 x double> %545, %610
  %612 = fadd contract <8 x double> %606, %611
  %613 = getelementptr inbounds i8, ptr %556, i64 88
  %614 = load double, ptr %613, align 8
  %615 = insertelement <8 x double> poison, double %614, i64 0
  %616 = shufflevector <8 x double> %615, <8 x double> poison, <8 x i32> zeroinitializer
  %617 = getelementptr inbounds i8, ptr %556, i64 48
  %618 = load double, ptr %617, align 8
  %619 = insertelement <8 x double> poison, double %618, i64 0
  %620 = shufflevector <8 x double> %619, <8 x double> poison, <8 x i32> zeroinitializer
  %621 = fmul contract <8 x double> %517, %620
  %622 = fadd contract <8 x double> %616, %621
  %623 = getelementptr inbounds i8, ptr %556, i64 56
  %624 = load double, ptr %623, align 8
  %625 = insertelement <8 x double> poison, double %624, i64 0
  %626 = shufflevector <8 x double> %625, <8 x double> poison, <8 x i32> zeroinitializer
  %627 = fmul contract <8 x double> %531, %626
  %628 = fadd contract <8 x double> %622, %627
  %629 = getelementptr inbounds i8, ptr %556, i64 64
  %630 = load double, ptr %629, align 8
  %631 = insertelement <8 x double> poison, double %630, i64 0
  %632 = shufflevector <8 x double> %631, <8 x double> poison, <8 x i32> zeroinitializer
  %633 = fmul contract <8 x double> %545, %632
  %634 = fadd contract <8 x double> %628, %633
  %635 = fmul contract <8 x double> %590, zeroinitializer
  %636 = getelementptr inbounds i8, ptr %556, i64 136
  %637 = load double, ptr %636, align 8
  %638 = fcmp contract une double %637, 0.000000e+00
  %639 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %634)
  %640 = select contract i1 %638, <8 x double> %634, <8 x double> %639
  %641 = getelementptr inbounds i8, ptr %556, i64 128
  %642 = load double, ptr %641, align 8
  %643 = fcmp contract une double %642, 0.000000e+00
  br i1 %643, label %644, label %649

644:
  %645 = fmul contract <8 x double> %590, %590
  %646 = fmul contract <8 x double> %612, %612
  %647 = fadd contract <8 x double> %645, %646
  %648 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %647)
  br label %651

649:
  %650 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %590)
  br label %651

651:
  %652 = phi contract <8 x double> [ %648, %644 ], [ %650, %649 ]
  %653 = getelementptr inbounds i8, ptr %556, i64 96
  %654 = load double, ptr %653, align 8
  %655 = insertelement <8 x double> poison, double %654, i64 0
  %656 = shufflevector <8 x double> %655, <8 x double> poison, <8 x i32> zeroinitializer
  %657 = fsub contract <8 x double> %652, %656
  %658 = fcmp contract ogt <8 x double> %657, %635
  %659 = select contract <8 x i1> %658, <8 x double> %657, <8 x double> %635
  %660 = getelementptr inbounds i8, ptr %556, i64 112
  %661 = load double, ptr %660, align 8
  %662 = insertelement <8 x double> poison, double %661, i64 0
  %663 = shufflevector <8 x double> %662, <8 x double> poison, <8 x i32> zeroinitializer
  %664 = fsub contract <8 x double> %640, %663
  %665 = fcmp contract ogt <8 x double> %664, %635
  %666 = select contract <8 x i1> %665, <8 x double> %664, <8 x double> %635
  %667 = fmul contract <8 x double> %659, %659
  %668 = fmul contract <8 x double> %666, %666
  %669 = fadd contract <8 x double> %667, %668
  br i1 %643, label %681, label %670

670:
  %671 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %612)
  %672 = getelementptr inbounds i8, ptr %556, i64 104
  %673 = load double, ptr %672, align 8
  %674 = insertelement <8 x double> poison, double %673, i64 0
  %675 = shufflevector <8 x double> %674, <8 x double> poison, <8 x i32> zeroinitializer
  %676 = fsub contract <8 x double> %671, %675
  %677 = fcmp contract ogt <8 x double> %676, %635
  %678 = select contract <8 x i1> %677, <8 x double> %676, <8 x double> %635
  %679 = fmul contract <8 x double> %678, %678
  %680 = fadd contract <8 x double> %669, %679
  br label %681

681:
  %682 = phi <8 x double> [ %680, %670 ], [ %669, %651 ]
  %683 = fmul contract <8 x double> %569, %569
  %684 = fcmp contract olt <8 x double> %682, %683
  %685 = bitcast <8 x i1> %684 to i8
  %686 = icmp eq i8 %685, 0
  br i1 %686, label %796, label %687

687:
  %688 = load i64, ptr %551, align 8
  %689 = load i64, ptr %552, align 8
  %690 = icmp slt i64 %688, %689
  br i1 %690, label %691, label %693

691:
  %692 = getelementptr inbounds i8, ptr %556, i64 104
  br label %699

693:
  %694 = phi <8 x i64> [ zeroinitializer, %687 ], [ %793, %789 ]
  %695 = or <8 x i64> %694, %554
  %696 = icmp eq <8 x i64> %695, zeroinitializer
  %697 = bitcast <8 x i1> %696 to i8
  %698 = icmp eq i8 %697, 0
  br i1 %698, label %1307, label %796

699:
  %700 = phi <8 x i64> [ zeroinitializer, %691 ], [ %793, %789 ]
  %701 = phi i64 [ %688, %691 ], [ %794, %789 ]
  %702 = getelementptr inbounds %struct.Sphere.8, ptr %193, i64 %701
  %703 = getelementptr inbounds i8, ptr %702, i64 24
  %704 = load double, ptr %703, align 8
  %705 = fadd contract double %561, %704
  %706 = insertelement <8 x double> poison, double %705, i64 0
  %707 = shufflevector <8 x double> %706, <8 x double> poison, <8 x i32> zeroinitializer
  %708 = fadd contract <8 x double> %547, %707
  %709 = fcmp contract ogt <8 x double> %708, zeroinitializer
  %710 = select contract <8 x i1> %709, <8 x double> %708, <8 x double> zeroinitializer
  %711 = load double, ptr %702, align 8
  %712 = getelementptr inbounds i8, ptr %702, i64 8
  %713 = load double, ptr %712, align 8
  %714 = getelementptr inbounds i8, ptr %702, i64 16
  %715 = load double, ptr %714, align 8
  %716 = insertelement <8 x double> poison, double %711, i64 0
  %717 = shufflevector <8 x double> %716, <8 x double> poison, <8 x i32> zeroinitializer
  %718 = fmul contract <8 x double> %501, %717
  %719 = fadd contract <8 x double> %500, %718
  %720 = insertelement <8 x double> poison, double %713, i64 0
  %721 = shufflevector <8 x double> %720, <8 x double> poison, <8 x i32> zeroinitializer
  %722 = fmul contract <8 x double> %507, %721
  %723 = fadd contract <8 x double> %719, %722
  %724 = insertelement <8 x double> poison, double %715, i64 0
  %725 = shufflevector <8 x double> %724, <8 x double> poison, <8 x i32> zeroinitializer
  %726 = fmul contract <8 x double> %513, %725
  %727 = fadd contract <8 x double> %723, %726
  %728 = fmul contract <8 x double> %521, %717
  %729 = fadd contract <8 x double> %519, %728
  %730 = fmul contract <8 x double> %525, %721
  %731 = fadd contract <8 x double> %729, %730
  %732 = fmul contract <8 x double> %529, %725
  %733 = fadd contract <8 x double> %731, %732
  %734 = fmul contract <8 x double> %535, %717
  %735 = fadd contract <8 x double> %533, %734
  %736 = fmul contract <8 x double> %539, %721
  %737 = fadd contract <8 x double> %735, %736
  %738 = fmul contract <8 x double> %543, %725
  %739 = fadd contract <8 x double> %737, %738
  %740 = fmul contract <8 x double> %576, %727
  %741 = fadd contract <8 x double> %573, %740
  %742 = fmul contract <8 x double> %582, %733
  %743 = fadd contract <8 x double> %742, %741
  %744 = fmul contract <8 x double> %588, %739
  %745 = fadd contract <8 x double> %744, %743
  %746 = fmul contract <8 x double> %598, %727
  %747 = fadd contract <8 x double> %594, %746
  %748 = fmul contract <8 x double> %604, %733
  %749 = fadd contract <8 x double> %748, %747
  %750 = fmul contract <8 x double> %610, %739
  %751 = fadd contract <8 x double> %750, %749
  %752 = fmul contract <8 x double> %620, %727
  %753 = fadd contract <8 x double> %616, %752
  %754 = fmul contract <8 x double> %626, %733
  %755 = fadd contract <8 x double> %754, %753
  %756 = fmul contract <8 x double> %632, %739
  %757 = fadd contract <8 x double> %756, %755
  %758 = fmul contract <8 x double> %745, zeroinitializer
  %759 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %757)
  %760 = select contract i1 %638, <8 x double> %757, <8 x double> %759
  br i1 %643, label %761, label %766

761:
  %762 = fmul contract <8 x double> %745, %745
  %763 = fmul contract <8 x double> %751, %751
  %764 = fadd contract <8 x double> %762, %763
  %765 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %764)
  br label %768

766:
  %767 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %745)
  br label %768

768:
  %769 = phi contract <8 x double> [ %765, %761 ], [ %767, %766 ]
  %770 = fsub contract <8 x double> %769, %656
  %771 = fcmp contract ogt <8 x double> %770, %758
  %772 = select contract <8 x i1> %771, <8 x double> %770, <8 x double> %758
  %773 = fsub contract <8 x double> %760, %663
  %774 = fcmp contract ogt <8 x double> %773, %758
  %775 = select contract <8 x i1> %774, <8 x double> %773, <8 x double> %758
  %776 = fmul contract <8 x double> %772, %772
  %777 = fmul contract <8 x double> %775, %775
  %778 = fadd contract <8 x double> %777, %776
  br i1 %643, label %789, label %779

779:
  %780 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %751)
  %781 = load double, ptr %692, align 8
  %782 = insertelement <8 x double> poison, double %781, i64 0
  %783 = shufflevector <8 x double> %782, <8 x double> poison, <8 x i32> zeroinitializer
  %784 = fsub contract <8 x double> %780, %783
  %785 = fcmp contract ogt <8 x double> %784, %758
  %786 = select contract <8 x i1> %785, <8 x double> %784, <8 x double> %758
  %787 = fmul contract <8 x double> %786, %786
  %788 = fadd contract <8 x double> %778, %787
  br label %789

789:
  %790 = phi <8 x double> [ %788, %779 ], [ %778, %768 ]
  %791 = fmul contract <8 x double> %710, %710
  %792 = fcmp contract olt <8 x double> %790, %791
  %793 = select <8 x i1> %792, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %700
  %794 = add nsw i64 %701, 1
  %795 = icmp eq i64 %794, %689
  br i1 %795, label %693, label %699

796:
  %797 = phi <8 x i64> [ %554, %681 ], [ %554, %553 ], [ %695, %693 ]
  %798 = add nuw nsw i64 %555, 1
  %799 = icmp eq i64 %798, %188
  br i1 %799, label %800, label %553

800:
  %801 = phi <8 x i64> [ %486, %485 ], [ %486, %492 ], [ %797, %796 ]
  %802 = add nuw i64 %487, 1
  %803 = icmp eq i64 %487, %49
  br i1 %803, label %804, label %485

804:
  %805 = phi <8 x i64> [ zeroinitializer, %469 ], [ %801, %800 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %8)
  br i1 %56, label %808, label %806

806:
  %807 = phi <8 x i64> [ %805, %804 ], [ %1304, %1302 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %8)
  br label %1307

808:
  %809 = phi <8 x i64> [ %1304, %1302 ], [ %805, %804 ]
  %810 = phi i64 [ %1303, %1302 ], [ 0, %804 ]
  %811 = phi i64 [ %1305, %1302 ], [ 0, %804 ]
  %812 = getelementptr inbounds %struct.LinkPair, ptr %194, i64 %811
  %813 = load i64, ptr %812, align 8
  %814 = getelementptr inbounds %struct.Sphere.8, ptr %195, i64 %813
  %815 = getelementptr inbounds i8, ptr %812, i64 8
  %816 = load i64, ptr %815, align 8
  %817 = getelementptr inbounds %struct.Sphere.8, ptr %195, i64 %816
  %818 = getelementptr inbounds %struct.Frame.3, ptr %14, i64 %813
  %819 = getelementptr inbounds %struct.Frame.3, ptr %14, i64 %816
  %820 = getelementptr inbounds <8 x double>, ptr %13, i64 %811
  %821 = load <8 x double>, ptr %820, align 64
  %822 = getelementptr inbounds double, ptr %196, i64 %811
  %823 = load double, ptr %822, align 8
  %824 = insertelement <8 x double> poison, double %823, i64 0
  %825 = shufflevector <8 x double> %824, <8 x double> poison, <8 x i32> zeroinitializer
  %826 = fadd contract <8 x double> %821, %825
  %827 = load double, ptr %817, align 8
  %828 = getelementptr inbounds i8, ptr %817, i64 8
  %829 = load double, ptr %828, align 8
  %830 = getelementptr inbounds i8, ptr %817, i64 16
  %831 = load double, ptr %830, align 8
  %832 = getelementptr inbounds i8, ptr %819, i64 576
  %833 = load <8 x double>, ptr %832, align 64
  %834 = load <8 x double>, ptr %819, align 64
  %835 = insertelement <8 x double> poison, double %827, i64 0
  %836 = shufflevector <8 x double> %835, <8 x double> poison, <8 x i32> zeroinitializer
  %837 = fmul contract <8 x double> %836, %834
  %838 = fadd contract <8 x double> %833, %837
  %839 = getelementptr inbounds i8, ptr %819, i64 64
  %840 = load <8 x double>, ptr %839, align 64
  %841 = insertelement <8 x double> poison, double %829, i64 0
  %842 = shufflevector <8 x double> %841, <8 x double> poison, <8 x i32> zeroinitializer
  %843 = fmul contract <8 x double> %842, %840
  %844 = fadd contract <8 x double> %838, %843
  %845 = getelementptr inbounds i8, ptr %819, i64 128
  %846 = load <8 x double>, ptr %845, align 64
  %847 = insertelement <8 x double> poison, double %831, i64 0
  %848 = shufflevector <8 x double> %847, <8 x double> poison, <8 x i32> zeroinitializer
  %849 = fmul contract <8 x double> %848, %846
  %850 = fadd contract <8 x double> %844, %849
  %851 = getelementptr inbounds i8, ptr %819, i64 640
  %852 = load <8 x double>, ptr %851, align 64
  %853 = getelementptr inbounds i8, ptr %819, i64 192
  %854 = load <8 x double>, ptr %853, align 64
  %855 = fmul contract <8 x double> %836, %854
  %856 = fadd contract <8 x double> %852, %855
  %857 = getelementptr inbounds i8, ptr %819, i64 256
  %858 = load <8 x double>, ptr %857, align 64
  %859 = fmul contract <8 x double> %842, %858
  %860 = fadd contract <8 x double> %856, %859
  %861 = getelementptr inbounds i8, ptr %819, i64 320
  %862 = load <8 x double>, ptr %861, align 64
  %863 = fmul contract <8 x double> %848, %862
  %864 = fadd contract <8 x double> %860, %863
  %865 = getelementptr inbounds i8, ptr %819, i64 704
  %866 = load <8 x double>, ptr %865, align 64
  %867 = getelementptr inbounds i8, ptr %819, i64 384
  %868 = load <8 x double>, ptr %867, align 64
  %869 = fmul contract <8 x double> %836, %868
  %870 = fadd contract <8 x double> %866, %869
  %871 = getelementptr inbounds i8, ptr %819, i64 448
  %872 = load <8 x double>, ptr %871, align 64
  %873 = fmul contract <8 x double> %842, %872
  %874 = fadd contract <8 x double> %870, %873
  %875 = getelementptr inbounds i8, ptr %819, i64 512
  %876 = load <8 x double>, ptr %875, align 64
  %877 = fmul contract <8 x double> %848, %876
  %878 = fadd contract <8 x double> %874, %877
  %879 = getelementptr inbounds i8, ptr %814, i64 24
  %880 = load double, ptr %879, align 8
  %881 = getelementptr inbounds i8, ptr %817, i64 24
  %882 = load double, ptr %881, align 8
  %883 = fadd contract double %880, %882
  %884 = insertelement <8 x double> poison, double %883, i64 0
  %885 = shufflevector <8 x double> %884, <8 x double> poison, <8 x i32> zeroinitializer
  %886 = fadd contract <8 x double> %826, %885
  %887 = fcmp contract ogt <8 x double> %886, zeroinitializer
  %888 = select contract <8 x i1> %887, <8 x double> %886, <8 x double> zeroinitializer
  %889 = load double, ptr %814, align 8
  %890 = getelementptr inbounds i8, ptr %814, i64 8
  %891 = load double, ptr %890, align 8
  %892 = getelementptr inbounds i8, ptr %814, i64 16
  %893 = load double, ptr %892, align 8
  %894 = getelementptr inbounds i8, ptr %818, i64 576
  %895 = load <8 x double>, ptr %894, align 64
  %896 = load <8 x double>, ptr %818, align 64
  %897 = insertelement <8 x double> poison, double %889, i64 0
  %898 = shufflevector <8 x double> %897, <8 x double> poison, <8 x i32> zeroinitializer
  %899 = fmul contract <8 x double> %898, %896
  %900 = fadd contract <8 x double> %895, %899
  %901 = getelementptr inbounds i8, ptr %818, i64 64
  %902 = load <8 x double>, ptr %901, align 64
  %903 = insertelement <8 x double> poison, double %891, i64 0
  %904 = shufflevector <8 x double> %903, <8 x double> poison, <8 x i32> zeroinitializer
  %905 = fmul contract <8 x double> %904, %902
  %906 = fadd contract <8 x double> %900, %905
  %907 = getelementptr inbounds i8, ptr %818, i64 128
  %908 = load <8 x double>, ptr %907, align 64
  %909 = insertelement <8 x double> poison, double %893, i64 0
  %910 = shufflevector <8 x double> %909, <8 x double> poison, <8 x i32> zeroinitializer
  %911 = fmul contract <8 x double> %910, %908
  %912 = fadd contract <8 x double> %906, %911
  %913 = getelementptr inbounds i8, ptr %818, i64 640
  %914 = load <8 x double>, ptr %913, align 64
  %915 = getelementptr inbounds i8, ptr %818, i64 192
  %916 = load <8 x double>, ptr %915, align 64
  %917 = fmul contract <8 x double> %898, %916
  %918 = fadd contract <8 x double> %914, %917
  %919 = getelementptr inbounds i8, ptr %818, i64 256
  %920 = load <8 x double>, ptr %919, align 64
  %921 = fmul contract <8 x double> %904, %920
  %922 = fadd contract <8 x double> %918, %921
  %923 = getelementptr inbounds i8, ptr %818, i64 320
  %924 = load <8 x double>, ptr %923, align 64
  %925 = fmul contract <8 x double> %910, %924
  %926 = fadd contract <8 x double> %922, %925
  %927 = getelementptr inbounds i8, ptr %818, i64 704
  %928 = load <8 x double>, ptr %927, align 64
  %929 = getelementptr inbounds i8, ptr %818, i64 384
  %930 = load <8 x double>, ptr %929, align 64
  %931 = fmul contract <8 x double> %898, %930
  %932 = fadd contract <8 x double> %928, %931
  %933 = getelementptr inbounds i8, ptr %818, i64 448
  %934 = load <8 x double>, ptr %933, align 64
  %935 = fmul contract <8 x double> %904, %934
  %936 = fadd contract <8 x double> %932, %935
  %937 = getelementptr inbounds i8, ptr %818, i64 512
  %938 = load <8 x double>, ptr %937, align 64
  %939 = fmul contract <8 x double> %910, %938
  %940 = fadd contract <8 x double> %936, %939
  %941 = fsub contract <8 x double> %912, %850
  %942 = fsub contract <8 x double> %926, %864
  %943 = fsub contract <8 x double> %940, %878
  %944 = fmul contract <8 x double> %941, %941
  %945 = fmul contract <8 x double> %942, %942
  %946 = fadd contract <8 x double> %944, %945
  %947 = fmul contract <8 x double> %943, %943
  %948 = fadd contract <8 x double> %946, %947
  %949 = fmul contract <8 x double> %888, %888
  %950 = fcmp contract olt <8 x double> %948, %949
  %951 = bitcast <8 x i1> %950 to i8
  %952 = icmp eq i8 %951, 0
  br i1 %952, label %1302, label %953

953:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %9)
  store i64 %813, ptr %9, align 16
  store i64 %816, ptr %38, align 8
  br label %960

954:
  %955 = getelementptr inbounds i8, ptr %812, i64 16
  %956 = load i64, ptr %955, align 8
  %957 = getelementptr inbounds i8, ptr %812, i64 24
  %958 = load i64, ptr %957, align 8
  %959 = icmp slt i64 %956, %958
  br i1 %959, label %1043, label %1041

960:
  %961 = phi i64 [ %810, %953 ], [ %1038, %1037 ]
  %962 = phi i64 [ 0, %953 ], [ %1039, %1037 ]
  %963 = getelementptr inbounds i8, ptr %9, i64 %962
  %964 = load i64, ptr %963, align 8
  %965 = shl nuw i64 1, %964
  %966 = and i64 %965, %961
  %967 = icmp eq i64 %966, 0
  br i1 %967, label %968, label %1037

968:
  %969 = or i64 %965, %961
  %970 = getelementptr inbounds i64, ptr %197, i64 %964
  %971 = load i64, ptr %970, align 8
  %972 = getelementptr i8, ptr %970, i64 8
  %973 = load i64, ptr %972, align 8
  %974 = icmp slt i64 %971, %973
  br i1 %974, label %975, label %1037

975:
  %976 = getelementptr inbounds %struct.Frame.3, ptr %14, i64 %964
  %977 = getelementptr inbounds i8, ptr %976, i64 576
  %978 = load <8 x double>, ptr %977, align 64
  %979 = load <8 x double>, ptr %976, align 64
  %980 = getelementptr inbounds i8, ptr %976, i64 64
  %981 = load <8 x double>, ptr %980, align 64
  %982 = getelementptr inbounds i8, ptr %976, i64 128
  %983 = load <8 x double>, ptr %982, align 64
  %984 = getelementptr inbounds i8, ptr %976, i64 640
  %985 = load <8 x double>, ptr %984, align 64
  %986 = getelementptr inbounds i8, ptr %976, i64 192
  %987 = load <8 x double>, ptr %986, align 64
  %988 = getelementptr inbounds i8, ptr %976, i64 256
  %989 = load <8 x double>, ptr %988, align 64
  %990 = getelementptr inbounds i8, ptr %976, i64 320
  %991 = load <8 x double>, ptr %990, align 64
  %992 = getelementptr inbounds i8, ptr %976, i64 704
  %993 = load <8 x double>, ptr %992, align 64
  %994 = getelementptr inbounds i8, ptr %976, i64 384
  %995 = load <8 x double>, ptr %994, align 64
  %996 = getelementptr inbounds i8, ptr %976, i64 448
  %997 = load <8 x double>, ptr %996, align 64
  %998 = getelementptr inbounds i8, ptr %976, i64 512
  %999 = load <8 x double>, ptr %998, align 64
  br label %1000

1000:
  %1001 = phi i64 [ %971, %975 ], [ %1035, %1000 ]
  %1002 = getelementptr inbounds %struct.Part.10, ptr %198, i64 %1001
  %1003 = load double, ptr %1002, align 8
  %1004 = getelementptr inbounds i8, ptr %1002, i64 8
  %1005 = load double, ptr %1004, align 8
  %1006 = getelementptr inbounds i8, ptr %1002, i64 16
  %1007 = load double, ptr %1006, align 8
  %1008 = insertelement <8 x double> poison, double %1003, i64 0
  %1009 = shufflevector <8 x double> %1008, <8 x double> poison, <8 x i32> zeroinitializer
  %1010 = fmul contract <8 x double> %979, %1009
  %1011 = fadd contract <8 x double> %978, %1010
  %1012 = insertelement <8 x double> poison, double %1005, i64 0
  %1013 = shufflevector <8 x double> %1012, <8 x double> poison, <8 x i32> zeroinitializer
  %1014 = fmul contract <8 x double> %981, %1013
  %1015 = fadd contract <8 x double> %1011, %1014
  %1016 = insertelement <8 x double> poison, double %1007, i64 0
  %1017 = shufflevector <8 x double> %1016, <8 x double> poison, <8 x i32> zeroinitializer
  %1018 = fmul contract <8 x double> %983, %1017
  %1019 = fadd contract <8 x double> %1015, %1018
  %1020 = fmul contract <8 x double> %987, %1009
  %1021 = fadd contract <8 x double> %985, %1020
  %1022 = fmul contract <8 x double> %989, %1013
  %1023 = fadd contract <8 x double> %1021, %1022
  %1024 = fmul contract <8 x double> %991, %1017
  %1025 = fadd contract <8 x double> %1023, %1024
  %1026 = fmul contract <8 x double> %995, %1009
  %1027 = fadd contract <8 x double> %993, %1026
  %1028 = fmul contract <8 x double> %997, %1013
  %1029 = fadd contract <8 x double> %1027, %1028
  %1030 = fmul contract <8 x double> %999, %1017
  %1031 = fadd contract <8 x double> %1029, %1030
  %1032 = getelementptr inbounds [192 x %struct.Point.7], ptr %8, i64 0, i64 %1001
  store <8 x double> %1019, ptr %1032, align 64
  %1033 = getelementptr inbounds i8, ptr %1032, i64 64
  store <8 x double> %1025, ptr %1033, align 64
  %1034 = getelementptr inbounds i8, ptr %1032, i64 128
  store <8 x double> %1031, ptr %1034, align 64
  %1035 = add nsw i64 %1001, 1
  %1036 = icmp eq i64 %1035, %973
  br i1 %1036, label %1037, label %1000

1037:
  %1038 = phi i64 [ %961, %960 ], [ %969, %968 ], [ %969, %1000 ]
  %1039 = add nuw nsw i64 %962, 8
  %1040 = icmp eq i64 %1039, 16
  br i1 %1040, label %954, label %960

1041:
  %1042 = phi <8 x i64> [ %809, %954 ], [ %1299, %1296 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %9)
  br label %1302

1043:
  %1044 = phi <8 x i64> [ %1299, %1296 ], [ %809, %954 ]
  %1045 = phi i64 [ %1300, %1296 ], [ %956, %954 ]
  %1046 = phi i1 [ %1297, %1296 ], [ false, %954 ]
  %1047 = phi i64 [ %1298, %1296 ], [ -1, %954 ]
  %1048 = getelementptr inbounds %struct.PartPair, ptr %199, i64 %1045
  %1049 = load i64, ptr %1048, align 8
  %1050 = getelementptr inbounds %struct.Part.10, ptr %198, i64 %1049
  %1051 = getelementptr inbounds i8, ptr %1048, i64 8
  %1052 = load i64, ptr %1051, align 8
  %1053 = getelementptr inbounds %struct.Part.10, ptr %198, i64 %1052
  %1054 = icmp eq i64 %1049, %1047
  br i1 %1054, label %1082, label %1055

1055:
  %1056 = getelementptr inbounds i8, ptr %1050, i64 56
  %1057 = load double, ptr %1056, align 8
  %1058 = fadd contract double %882, %1057
  %1059 = insertelement <8 x double> poison, double %1058, i64 0
  %1060 = shufflevector <8 x double> %1059, <8 x double> poison, <8 x i32> zeroinitializer
  %1061 = fadd contract <8 x double> %826, %1060
  %1062 = fcmp contract ogt <8 x double> %1061, zeroinitializer
  %1063 = select contract <8 x i1> %1062, <8 x double> %1061, <8 x double> zeroinitializer
  %1064 = getelementptr inbounds [192 x %struct.Point.7], ptr %8, i64 0, i64 %1049
  %1065 = load <8 x double>, ptr %1064, align 64
  %1066 = fsub contract <8 x double> %1065, %850
  %1067 = getelementptr inbounds i8, ptr %1064, i64 64
  %1068 = load <8 x double>, ptr %1067, align 64
  %1069 = fsub contract <8 x double> %1068, %864
  %1070 = getelementptr inbounds i8, ptr %1064, i64 128
  %1071 = load <8 x double>, ptr %1070, align 64
  %1072 = fsub contract <8 x double> %1071, %878
  %1073 = fmul contract <8 x double> %1066, %1066
  %1074 = fmul contract <8 x double> %1069, %1069
  %1075 = fadd contract <8 x double> %1073, %1074
  %1076 = fmul contract <8 x double> %1072, %1072
  %1077 = fadd contract <8 x double> %1075, %1076
  %1078 = fmul contract <8 x double> %1063, %1063
  %1079 = fcmp contract olt <8 x double> %1077, %1078
  %1080 = bitcast <8 x i1> %1079 to i8
  %1081 = icmp eq i8 %1080, 0
  br i1 %1081, label %1296, label %1092

1082:
  br i1 %1046, label %1083, label %1296

1083:
  %1084 = getelementptr inbounds i8, ptr %1050, i64 56
  %1085 = load double, ptr %1084, align 8
  %1086 = getelementptr inbounds [192 x %struct.Point.7], ptr %8, i64 0, i64 %1047
  %1087 = load <8 x double>, ptr %1086, align 64
  %1088 = getelementptr inbounds i8, ptr %1086, i64 64
  %1089 = load <8 x double>, ptr %1088, align 64
  %1090 = getelementptr inbounds i8, ptr %1086, i64 128
  %1091 = load <8 x double>, ptr %1090, align 64
  br label %1092

1092:
  %1093 = phi <8 x double> [ %1071, %1055 ], [ %1091, %1083 ]
  %1094 = phi <8 x double> [ %1068, %1055 ], [ %1089, %1083 ]
  %1095 = phi <8 x double> [ %1065, %1055 ], [ %1087, %1083 ]
  %1096 = phi double [ %1057, %1055 ], [ %1085, %1083 ]
  %1097 = phi i64 [ %1049, %1055 ], [ %1047, %1083 ]
  %1098 = getelementptr inbounds i8, ptr %1053, i64 56
  %1099 = load double, ptr %1098, align 8
  %1100 = fadd contract double %1096, %1099
  %1101 = insertelement <8 x double> poison, double %1100, i64 0
  %1102 = shufflevector <8 x double> %1101, <8 x double> poison, <8 x i32> zeroinitializer
  %1103 = fadd contract <8 x double> %826, %1102
  %1104 = fcmp contract ogt <8 x double> %1103, zeroinitializer
  %1105 = select contract <8 x i1> %1104, <8 x double> %1103, <8 x double> zeroinitializer
  %1106 = getelementptr inbounds [192 x %struct.Point.7], ptr %8, i64 0, i64 %1052
  %1107 = load <8 x double>, ptr %1106, align 64
  %1108 = fsub contract <8 x double> %1095, %1107
  %1109 = getelementptr inbounds i8, ptr %1106, i64 64
  %1110 = load <8 x double>, ptr %1109, align 64
  %1111 = fsub contract <8 x double> %1094, %1110
  %1112 = getelementptr inbounds i8, ptr %1106, i64 128
  %1113 = load <8 x double>, ptr %1112, align 64
  %1114 = fsub contract <8 x double> %1093, %1113
  %1115 = fmul contract <8 x double> %1108, %1108
  %1116 = fmul contract <8 x double> %1111, %1111
  %1117 = fadd contract <8 x double> %1115, %1116
  %1118 = fmul contract <8 x double> %1114, %1114
  %1119 = fadd contract <8 x double> %1117, %1118
  %1120 = fmul contract <8 x double> %1105, %1105
  %1121 = fcmp contract olt <8 x double> %1119, %1120
  %1122 = bitcast <8 x i1> %1121 to i8
  %1123 = icmp eq i8 %1122, 0
  br i1 %1123, label %1296, label %1124

1124:
  %1125 = getelementptr inbounds i8, ptr %1050, i64 48
  %1126 = load double, ptr %1125, align 8
  %1127 = getelementptr inbounds i8, ptr %1053, i64 48
  %1128 = load double, ptr %1127, align 8
  %1129 = fadd contract double %1126, %1128
  %1130 = insertelement <8 x double> poison, double %1129, i64 0
  %1131 = shufflevector <8 x double> %1130, <8 x double> poison, <8 x i32> zeroinitializer
  %1132 = fadd contract <8 x double> %826, %1131
  %1133 = fcmp contract ogt <8 x double> %1132, zeroinitializer
  %1134 = select contract <8 x i1> %1133, <8 x double> %1132, <8 x double> zeroinitializer
  %1135 = getelementptr inbounds i8, ptr %1050, i64 24
  %1136 = load double, ptr %1135, align 8
  %1137 = fmul contract double %1136, %1136
  %1138 = getelementptr inbounds i8, ptr %1050, i64 32
  %1139 = load double, ptr %1138, align 8
  %1140 = fmul contract double %1139, %1139
  %1141 = fadd contract double %1137, %1140
  %1142 = getelementptr inbounds i8, ptr %1050, i64 40
  %1143 = load double, ptr %1142, align 8
  %1144 = fmul contract double %1143, %1143
  %1145 = fadd contract double %1141, %1144
  %1146 = getelementptr inbounds i8, ptr %1053, i64 24
  %1147 = load double, ptr %1146, align 8
  %1148 = fmul contract double %1147, %1147
  %1149 = getelementptr inbounds i8, ptr %1053, i64 32
  %1150 = load double, ptr %1149, align 8
  %1151 = fmul contract double %1150, %1150
  %1152 = fadd contract double %1148, %1151
  %1153 = getelementptr inbounds i8, ptr %1053, i64 40
  %1154 = load double, ptr %1153, align 8
  %1155 = fmul contract double %1154, %1154
  %1156 = fadd contract double %1152, %1155
  %1157 = fcmp contract oeq double %1145, 0.000000e+00
  %1158 = fcmp contract oeq double %1156, 0.000000e+00
  %1159 = select i1 %1157, i1 %1158, i1 false
  br i1 %1159, label %1291, label %1160

1160:
  %1161 = fmul contract <8 x double> %1095, zeroinitializer
  %1162 = fadd contract <8 x double> %1161, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %1163 = insertelement <8 x double> poison, double %1136, i64 0
  %1164 = shufflevector <8 x double> %1163, <8 x double> poison, <8 x i32> zeroinitializer
  %1165 = fmul contract <8 x double> %896, %1164
  %1166 = insertelement <8 x double> poison, double %1139, i64 0
  %1167 = shufflevector <8 x double> %1166, <8 x double> poison, <8 x i32> zeroinitializer
  %1168 = fmul contract <8 x double> %902, %1167
  %1169 = fadd contract <8 x double> %1165, %1168
  %1170 = insertelement <8 x double> poison, double %1143, i64 0
  %1171 = shufflevector <8 x double> %1170, <8 x double> poison, <8 x i32> zeroinitializer
  %1172 = fmul contract <8 x double> %908, %1171
  %1173 = fadd contract <8 x double> %1169, %1172
  %1174 = fmul contract <8 x double> %916, %1164
  %1175 = fmul contract <8 x double> %920, %1167
  %1176 = fadd contract <8 x double> %1174, %1175
  %1177 = fmul contract <8 x double> %924, %1171
  %1178 = fadd contract <8 x double> %1176, %1177
  %1179 = fmul contract <8 x double> %930, %1164
  %1180 = fmul contract <8 x double> %934, %1167
  %1181 = fadd contract <8 x double> %1179, %1180
  %1182 = fmul contract <8 x double> %938, %1171
  %1183 = fadd contract <8 x double> %1181, %1182
  %1184 = insertelement <8 x double> poison, double %1147, i64 0
  %1185 = shufflevector <8 x double> %1184, <8 x double> poison, <8 x i32> zeroinitializer
  %1186 = fmul contract <8 x double> %834, %1185
  %1187 = insertelement <8 x double> poison, double %1150, i64 0
  %1188 = shufflevector <8 x double> %1187, <8 x double> poison, <8 x i32> zeroinitializer
  %1189 = fmul contract <8 x double> %840, %1188
  %1190 = fadd contract <8 x double> %1186, %1189
  %1191 = insertelement <8 x double> poison, double %1154, i64 0
  %1192 = shufflevector <8 x double> %1191, <8 x double> poison, <8 x i32> zeroinitializer
  %1193 = fmul contract <8 x double> %846, %1192
  %1194 = fadd contract <8 x double> %1190, %1193
  %1195 = fmul contract <8 x double> %854, %1185
  %1196 = fmul contract <8 x double> %858, %1188
  %1197 = fadd contract <8 x double> %1195, %1196
  %1198 = fmul contract <8 x double> %862, %1192
  %1199 = fadd contract <8 x double> %1197, %1198
  %1200 = fmul contract <8 x double> %868, %1185
  %1201 = fmul contract <8 x double> %872, %1188
  %1202 = fadd contract <8 x double> %1200, %1201
  %1203 = fmul contract <8 x double> %876, %1192
  %1204 = fadd contract <8 x double> %1202, %1203
  %1205 = fcmp contract ogt double %1145, 0.000000e+00
  %1206 = fdiv contract double 1.000000e+00, %1145
  %1207 = select contract i1 %1205, double %1206, double 0.000000e+00
  %1208 = fcmp contract ogt double %1156, 0.000000e+00
  %1209 = fdiv contract double 1.000000e+00, %1156
  %1210 = select contract i1 %1208, double %1209, double 0.000000e+00
  %1211 = fmul contract <8 x double> %1173, %1194
  %1212 = fmul contract <8 x double> %1178, %1199
  %1213 = fadd contract <8 x double> %1211, %1212
  %1214 = fmul contract <8 x double> %1183, %1204
  %1215 = fadd contract <8 x double> %1214, %1213
  %1216 = fmul contract <8 x double> %1108, %1173
  %1217 = fmul contract <8 x double> %1111, %1178
  %1218 = fadd contract <8 x double> %1216, %1217
  %1219 = fmul contract <8 x double> %1114, %1183
  %1220 = fadd contract <8 x double> %1219, %1218
  %1221 = fmul contract <8 x double> %1108, %1194
  %1222 = fmul contract <8 x double> %1111, %1199
  %1223 = fadd contract <8 x double> %1221, %1222
  %1224 = fmul contract <8 x double> %1114, %1204
  %1225 = fadd contract <8 x double> %1224, %1223
  %1226 = fmul contract double %1145, %1156
  %1227 = insertelement <8 x double> poison, double %1226, i64 0
  %1228 = shufflevector <8 x double> %1227, <8 x double> poison, <8 x i32> zeroinitializer
  %1229 = fmul contract <8 x double> %1215, %1215
  %1230 = fsub contract <8 x double> %1228, %1229
  %1231 = fmul contract double %1145, 0x3E7AD7F29ABCAF48
  %1232 = fmul contract double %1231, %1156
  %1233 = insertelement <8 x double> poison, double %1232, i64 0
  %1234 = shufflevector <8 x double> %1233, <8 x double> poison, <8 x i32> zeroinitializer
  %1235 = fcmp contract ogt <8 x double> %1230, %1234
  %1236 = fmul contract <8 x double> %1215, %1225
  %1237 = insertelement <8 x double> poison, double %1156, i64 0
  %1238 = shufflevector <8 x double> %1237, <8 x double> poison, <8 x i32> zeroinitializer
  %1239 = fmul contract <8 x double> %1238, %1220
  %1240 = fsub contract <8 x double> %1236, %1239
  %1241 = select contract <8 x i1> %1235, <8 x double> %1230, <8 x double> %1162
  %1242 = fdiv contract <8 x double> %1240, %1241
  %1243 = fneg contract <8 x double> %1162
  %1244 = fcmp contract ogt <8 x double> %1242, %1243
  %1245 = select contract <8 x i1> %1244, <8 x double> %1242, <8 x double> %1243
  %1246 = fcmp contract olt <8 x double> %1245, %1162
  %1247 = select contract <8 x i1> %1246, <8 x double> %1245, <8 x double> %1162
  %1248 = select contract <8 x i1> %1235, <8 x double> %1247, <8 x double> %1243
  %1249 = fmul contract <8 x double> %1215, %1248
  %1250 = fadd contract <8 x double> %1225, %1249
  %1251 = insertelement <8 x double> poison, double %1210, i64 0
  %1252 = shufflevector <8 x double> %1251, <8 x double> poison, <8 x i32> zeroinitializer
  %1253 = fmul contract <8 x double> %1252, %1250
  %1254 = fcmp contract ogt <8 x double> %1253, %1243
  %1255 = select contract <8 x i1> %1254, <8 x double> %1253, <8 x double> %1243
  %1256 = fcmp contract olt <8 x double> %1255, %1162
  %1257 = select contract <8 x i1> %1256, <8 x double> %1255, <8 x double> %1162
  %1258 = fmul contract <8 x double> %1215, %1257
  %1259 = fsub contract <8 x double> %1258, %1220
  %1260 = insertelement <8 x double> poison, double %1207, i64 0
  %1261 = shufflevector <8 x double> %1260, <8 x double> poison, <8 x i32> zeroinitializer
  %1262 = fmul contract <8 x double> %1261, %1259
  %1263 = fcmp contract ogt <8 x double> %1262, %1243
  %1264 = select contract <8 x i1> %1263, <8 x double> %1262, <8 x double> %1243
  %1265 = fcmp contract olt <8 x double> %1264, %1162
  %1266 = select contract <8 x i1> %1265, <8 x double> %1264, <8 x double> %1162
  %1267 = fmul contract <8 x double> %1215, %1266
  %1268 = fadd contract <8 x double> %1225, %1267
  %1269 = fmul contract <8 x double> %1252, %1268
  %1270 = fcmp contract ogt <8 x double> %1269, %1243
  %1271 = select contract <8 x i1> %1270, <8 x double> %1269, <8 x double> %1243
  %1272 = fcmp contract olt <8 x double> %1271, %1162
  %1273 = select contract <8 x i1> %1272, <8 x double> %1271, <8 x double> %1162
  %1274 = fmul contract <8 x double> %1173, %1266
  %1275 = fadd contract <8 x double> %1108, %1274
  %1276 = fmul contract <8 x double> %1194, %1273
  %1277 = fsub contract <8 x double> %1275, %1276
  %1278 = fmul contract <8 x double> %1178, %1266
  %1279 = fadd contract <8 x double> %1111, %1278
  %1280 = fmul contract <8 x double> %1199, %1273
  %1281 = fsub contract <8 x double> %1279, %1280
  %1282 = fmul contract <8 x double> %1183, %1266
  %1283 = fadd contract <8 x double> %1114, %1282
  %1284 = fmul contract <8 x double> %1204, %1273
  %1285 = fsub contract <8 x double> %1283, %1284
  %1286 = fmul contract <8 x double> %1277, %1277
  %1287 = fmul contract <8 x double> %1281, %1281
  %1288 = fadd contract <8 x double> %1286, %1287
  %1289 = fmul contract <8 x double> %1285, %1285
  %1290 = fadd contract <8 x double> %1289, %1288
  br label %1291

1291:
  %1292 = phi <8 x double> [ %1290, %1160 ], [ %1119, %1124 ]
  %1293 = fmul contract <8 x double> %1134, %1134
  %1294 = fcmp contract olt <8 x double> %1292, %1293
  %1295 = select <8 x i1> %1294, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %1044
  br label %1296

1296:
  %1297 = phi i1 [ true, %1291 ], [ false, %1082 ], [ true, %1092 ], [ false, %1055 ]
  %1298 = phi i64 [ %1097, %1291 ], [ %1047, %1082 ], [ %1097, %1092 ], [ %1049, %1055 ]
  %1299 = phi <8 x i64> [ %1295, %1291 ], [ %1044, %1082 ], [ %1044, %1092 ], [ %1044, %1055 ]
  %1300 = add nsw i64 %1045, 1
  %1301 = icmp eq i64 %1300, %958
  br i1 %1301, label %1041, label %1043

1302:
  %1303 = phi i64 [ %1038, %1041 ], [ %810, %808 ]
  %1304 = phi <8 x i64> [ %1042, %1041 ], [ %809, %808 ]
  %1305 = add nuw nsw i64 %811, 1
  %1306 = icmp eq i64 %1305, %55
  br i1 %1306, label %806, label %808

1307:
  %1308 = phi <8 x i64> [ %807, %806 ], [ %695, %693 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 8704, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 1088, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %11)
  %1309 = icmp sgt i64 %211, 0
  br i1 %1309, label %1327, label %1357

1310:
  %1311 = phi <8 x double> [ %212, %210 ], [ %1321, %1310 ]
  %1312 = phi <8 x double> [ %213, %210 ], [ %1324, %1310 ]
  %1313 = phi i64 [ 0, %210 ], [ %1325, %1310 ]
  %1314 = icmp sgt i64 %211, %1313
  %1315 = xor i64 %1313, -1
  %1316 = select i1 %1314, i64 %1315, i64 -1
  %1317 = add i64 %1316, %211
  %1318 = getelementptr inbounds [4096 x %struct.Piece], ptr %16, i64 0, i64 %1317
  %1319 = getelementptr inbounds [8 x %struct.Piece], ptr %17, i64 0, i64 %1313
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %1319, ptr noundef nonnull align 16 dereferenceable(16) %1318, i64 16, i1 false)
  %1320 = load double, ptr %1319, align 16
  %1321 = insertelement <8 x double> %1311, double %1320, i64 %1313
  %1322 = getelementptr inbounds i8, ptr %1319, i64 8
  %1323 = load double, ptr %1322, align 8
  %1324 = insertelement <8 x double> %1312, double %1323, i64 %1313
  %1325 = add nuw nsw i64 %1313, 1
  %1326 = icmp eq i64 %1325, 8
  br i1 %1326, label %214, label %1310

1327:
  %1328 = phi i64 [ %1354, %1353 ], [ %216, %1307 ]
  %1329 = phi i64 [ %1355, %1353 ], [ 0, %1307 ]
  %1330 = extractelement <8 x i64> %1308, i64 %1329
  %1331 = icmp eq i64 %1330, 0
  br i1 %1331, label %1353, label %1332

1332:
  %1333 = getelementptr inbounds [8 x %struct.Piece], ptr %17, i64 0, i64 %1329
  %1334 = getelementptr inbounds i8, ptr %1333, i64 8
  %1335 = load double, ptr %1334, align 8
  %1336 = fmul contract double %182, %1335
  %1337 = fmul contract double %1336, 2.000000e+00
  %1338 = fcmp contract olt double %1337, %5
  %1339 = icmp sgt i64 %1328, 4094
  %1340 = select i1 %1338, i1 true, i1 %1339
  br i1 %1340, label %1341, label %1342

1341:
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %17)
  br label %1360

1342:
  %1343 = fmul contract double %1335, 5.000000e-01
  %1344 = load double, ptr %1333, align 16
  %1345 = fsub contract double %1344, %1343
  %1346 = add nsw i64 %1328, 1
  %1347 = getelementptr inbounds [4096 x %struct.Piece], ptr %16, i64 0, i64 %1328
  store double %1345, ptr %1347, align 16
  %1348 = getelementptr inbounds i8, ptr %1347, i64 8
  store double %1343, ptr %1348, align 8
  %1349 = fadd contract double %1343, %1344
  %1350 = add nsw i64 %1328, 2
  %1351 = getelementptr inbounds [4096 x %struct.Piece], ptr %16, i64 0, i64 %1346
  store double %1349, ptr %1351, align 16
  %1352 = getelementptr inbounds i8, ptr %1351, i64 8
  store double %1343, ptr %1352, align 8
  br label %1353

1353:
  %1354 = phi i64 [ %1328, %1327 ], [ %1350, %1342 ]
  %1355 = add nuw nsw i64 %1329, 1
  %1356 = icmp eq i64 %1355, %215
  br i1 %1356, label %1357, label %1327

1357:
  %1358 = phi i64 [ %216, %1307 ], [ %1354, %1353 ]
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %17)
  %1359 = icmp eq i64 %1358, 0
  br i1 %1359, label %1360, label %210

1360:
  %1361 = phi i8 [ 0, %1341 ], [ 1, %1357 ]
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %16)
  call void @llvm.lifetime.end.p0(i64 2448, ptr nonnull %15)
  %1362 = getelementptr inbounds i8, ptr %6, i64 %44
  store i8 %1361, ptr %1362, align 1
  %1363 = add nuw nsw i64 %44, 1
  %1364 = icmp eq i64 %1363, %4
  br i1 %1364, label %42, label %43
}

define i64 @check_spans(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, i64 noundef %2, ptr nocapture noundef %3, i64 noundef %4, ptr nocapture noundef %5) {
  %7 = alloca [16 x double], align 16
  %8 = alloca [16 x double], align 16
  %9 = alloca [16 x double], align 16
  %10 = alloca [16 x double], align 16
  %11 = alloca [16 x double], align 16
  %12 = alloca [16 x double], align 16
  %13 = alloca [192 x %struct.Point], align 64
  %14 = alloca [2 x i64], align 16
  %15 = alloca [9 x <16 x float>], align 64
  %16 = alloca [16 x <16 x float>], align 64
  %17 = alloca [16 x <16 x float>], align 64
  %18 = alloca [16 x <16 x float>], align 64
  %19 = alloca [17 x <16 x float>], align 64
  %20 = alloca [136 x <16 x float>], align 64
  %21 = alloca [16 x <16 x float>], align 64
  %22 = alloca [16 x <16 x float>], align 64
  %23 = alloca [16 x <16 x float>], align 64
  %24 = alloca [16 x <16 x float>], align 64
  %25 = alloca [16 x float], align 16
  %26 = alloca [16 x float], align 16
  %27 = alloca [17 x %struct.Frame], align 64
  %28 = alloca [17 x [17 x <16 x float>]], align 64
  %29 = alloca [17 x [17 x <16 x float>]], align 64
  %30 = alloca [4096 x %struct.SpanPiece], align 16
  %31 = alloca [16 x %struct.SpanPiece], align 16
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %30)
  %32 = icmp sgt i64 %2, 0
  br i1 %32, label %56, label %1821

33:
  br i1 %32, label %34, label %1821

34:
  %35 = getelementptr inbounds i8, ptr %1, i64 8
  %36 = getelementptr inbounds i8, ptr %1, i64 24
  %37 = getelementptr inbounds i8, ptr %1, i64 16
  %38 = getelementptr inbounds i8, ptr %1, i64 36
  %39 = getelementptr inbounds i8, ptr %0, i64 24
  %40 = getelementptr inbounds i8, ptr %27, i64 576
  %41 = getelementptr inbounds i8, ptr %1, i64 32
  %42 = getelementptr inbounds i8, ptr %0, i64 88
  %43 = getelementptr inbounds i8, ptr %0, i64 16
  %44 = getelementptr inbounds i8, ptr %0, i64 96
  %45 = getelementptr inbounds i8, ptr %0, i64 48
  %46 = getelementptr inbounds i8, ptr %0, i64 8
  %47 = getelementptr inbounds i8, ptr %0, i64 56
  %48 = getelementptr inbounds i8, ptr %0, i64 64
  %49 = getelementptr inbounds i8, ptr %0, i64 32
  %50 = getelementptr inbounds i8, ptr %0, i64 40
  %51 = getelementptr inbounds i8, ptr %0, i64 128
  %52 = getelementptr inbounds i8, ptr %14, i64 8
  %53 = getelementptr inbounds i8, ptr %0, i64 80
  %54 = getelementptr inbounds i8, ptr %0, i64 72
  %55 = getelementptr inbounds i8, ptr %0, i64 104
  br label %61

56:
  %57 = phi i64 [ %59, %56 ], [ 0, %6 ]
  %58 = getelementptr inbounds i8, ptr %5, i64 %57
  store i8 0, ptr %58, align 1
  %59 = add nuw nsw i64 %57, 1
  %60 = icmp eq i64 %59, %2
  br i1 %60, label %33, label %56

61:
  %62 = phi i64 [ 0, %34 ], [ %1817, %1816 ]
  %63 = phi i64 [ 0, %34 ], [ %108, %1816 ]
  %64 = phi i64 [ 0, %34 ], [ %1767, %1816 ]
  call void @llvm.lifetime.start.p0(i64 256, ptr nonnull %31)
  %65 = icmp sgt i64 %62, 15
  %66 = add nsw i64 %63, 16
  %67 = icmp sgt i64 %66, %2
  %68 = select i1 %65, i1 true, i1 %67
  br label %69

69:
  %70 = phi i64 [ %62, %61 ], [ %93, %88 ]
  %71 = phi i64 [ %63, %61 ], [ %92, %88 ]
  %72 = phi i64 [ 0, %61 ], [ %101, %88 ]
  %73 = icmp ne i64 %70, 0
  %74 = icmp slt i64 %71, %2
  %75 = select i1 %73, i1 true, i1 %74
  br i1 %75, label %76, label %103

76:
  %77 = and i1 %68, %73
  br i1 %77, label %80, label %78

78:
  %79 = add nsw i64 %71, 1
  br label %88

80:
  %81 = add nsw i64 %70, -1
  %82 = getelementptr inbounds [4096 x %struct.SpanPiece], ptr %30, i64 0, i64 %81
  %83 = load i64, ptr %82, align 16
  %84 = getelementptr inbounds i8, ptr %82, i64 8
  %85 = load float, ptr %84, align 8
  %86 = getelementptr inbounds i8, ptr %82, i64 12
  %87 = load float, ptr %86, align 4
  br label %88

88:
  %89 = phi i64 [ %83, %80 ], [ %71, %78 ]
  %90 = phi float [ %85, %80 ], [ 0.000000e+00, %78 ]
  %91 = phi float [ %87, %80 ], [ 1.000000e+00, %78 ]
  %92 = phi i64 [ %71, %80 ], [ %79, %78 ]
  %93 = phi i64 [ %81, %80 ], [ %70, %78 ]
  %94 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %72
  store i64 %89, ptr %94, align 16
  %95 = getelementptr inbounds i8, ptr %94, i64 8
  store float %90, ptr %95, align 8
  %96 = getelementptr inbounds i8, ptr %94, i64 12
  store float %91, ptr %96, align 4
  %97 = getelementptr inbounds i8, ptr %5, i64 %89
  %98 = load i8, ptr %97, align 1
  %99 = icmp eq i8 %98, 0
  %100 = zext i1 %99 to i64
  %101 = add nuw nsw i64 %72, %100
  %102 = icmp ult i64 %101, 16
  br i1 %102, label %69, label %106

103:
  %104 = icmp eq i64 %72, 0
  br i1 %104, label %105, label %1774

105:
  call void @llvm.lifetime.end.p0(i64 256, ptr nonnull %31)
  br label %1821

106:
  %107 = phi i64 [ %72, %1774 ], [ 16, %88 ]
  %108 = phi i64 [ %71, %1774 ], [ %92, %88 ]
  %109 = phi i64 [ 0, %1774 ], [ %93, %88 ]
  %110 = shl nsw i64 -1, %107
  %111 = xor i64 %110, -1
  %112 = load i64, ptr %0, align 8
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %16)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %17)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %18)
  call void @llvm.lifetime.start.p0(i64 1088, ptr nonnull %19)
  call void @llvm.lifetime.start.p0(i64 8704, ptr nonnull %20)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %21)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %22)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %23)
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %24)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %25)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %26)
  br label %161

113:
  %114 = icmp sgt i64 %109, 4064
  %115 = load <16 x float>, ptr %25, align 16
  %116 = load <16 x float>, ptr %26, align 16
  %117 = fsub contract <16 x float> %116, %115
  %118 = load ptr, ptr %35, align 8
  %119 = load i64, ptr %36, align 8
  %120 = load i64, ptr %37, align 8
  %121 = mul nsw i64 %120, %119
  %122 = getelementptr inbounds double, ptr %118, i64 %121
  br i1 %68, label %123, label %133

123:
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %12)
  br label %124

124:
  %125 = phi i64 [ 0, %123 ], [ %131, %124 ]
  %126 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %125
  %127 = load i64, ptr %126, align 16
  %128 = getelementptr inbounds double, ptr %122, i64 %127
  %129 = load double, ptr %128, align 8
  %130 = getelementptr inbounds [16 x double], ptr %12, i64 0, i64 %125
  store double %129, ptr %130, align 8
  %131 = add nuw nsw i64 %125, 1
  %132 = icmp eq i64 %131, 16
  br i1 %132, label %141, label %124

133:
  %134 = load ptr, ptr %1, align 8
  %135 = load i64, ptr %31, align 16
  %136 = getelementptr inbounds double, ptr %122, i64 %135
  %137 = load <16 x double>, ptr %136, align 8
  %138 = getelementptr inbounds double, ptr %134, i64 %121
  %139 = getelementptr inbounds double, ptr %138, i64 %135
  %140 = load <16 x double>, ptr %139, align 8
  br label %156

141:
  %142 = load <16 x double>, ptr %12, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %12)
  %143 = load ptr, ptr %1, align 8
  %144 = getelementptr inbounds double, ptr %143, i64 %121
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %11)
  br label %147

145:
  %146 = load <16 x double>, ptr %11, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %11)
  br label %156

147:
  %148 = phi i64 [ 0, %141 ], [ %154, %147 ]
  %149 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %148
  %150 = load i64, ptr %149, align 16
  %151 = getelementptr inbounds double, ptr %144, i64 %150
  %152 = load double, ptr %151, align 8
  %153 = getelementptr inbounds [16 x double], ptr %11, i64 0, i64 %148
  store double %152, ptr %153, align 8
  %154 = add nuw nsw i64 %148, 1
  %155 = icmp eq i64 %154, 16
  br i1 %155, label %145, label %147

156:
  %157 = phi ptr [ %134, %133 ], [ %143, %145 ]
  %158 = phi <16 x double> [ %137, %133 ], [ %142, %145 ]
  %159 = phi <16 x double> [ %140, %133 ], [ %146, %145 ]
  %160 = fsub contract <16 x double> %158, %159
  br i1 %114, label %180, label %171

161:
  %162 = phi i64 [ 0, %106 ], [ %169, %161 ]
  %163 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %162, i32 1
  %164 = load float, ptr %163, align 8
  %165 = getelementptr inbounds [16 x float], ptr %25, i64 0, i64 %162
  store float %164, ptr %165, align 4
  %166 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %162, i32 2
  %167 = load float, ptr %166, align 4
  %168 = getelementptr inbounds [16 x float], ptr %26, i64 0, i64 %162
  store float %167, ptr %168, align 4
  %169 = add nuw nsw i64 %162, 1
  %170 = icmp eq i64 %169, 16
  br i1 %170, label %113, label %161

171:
  %172 = fptrunc <16 x double> %160 to <16 x float>
  %173 = fmul contract <16 x float> %117, %172
  %174 = load float, ptr %38, align 4
  %175 = insertelement <16 x float> poison, float %174, i64 0
  %176 = shufflevector <16 x float> %175, <16 x float> poison, <16 x i32> zeroinitializer
  %177 = fcmp contract ole <16 x float> %173, %176
  %178 = bitcast <16 x i1> %177 to i16
  %179 = zext i16 %178 to i64
  br label %180

180:
  %181 = phi i64 [ %179, %171 ], [ -1, %156 ]
  %182 = icmp sgt i64 %112, 0
  br i1 %182, label %183, label %294

183:
  %184 = load i64, ptr %31, align 16
  %185 = load ptr, ptr %39, align 8
  %186 = getelementptr double, ptr %157, i64 %184
  %187 = getelementptr double, ptr %118, i64 %184
  br label %193

188:
  br i1 %182, label %189, label %294

189:
  %190 = fmul contract <16 x float> %115, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  %191 = fmul contract <16 x float> %116, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  %192 = fdiv contract <16 x float> %117, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  br label %507

193:
  %194 = phi i64 [ 0, %183 ], [ %292, %287 ]
  %195 = mul nsw i64 %194, %120
  %196 = getelementptr inbounds double, ptr %157, i64 %195
  br i1 %68, label %200, label %197

197:
  %198 = getelementptr inbounds double, ptr %196, i64 %184
  %199 = load <16 x double>, ptr %198, align 8
  br label %212

200:
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %10)
  br label %203

201:
  %202 = load <16 x double>, ptr %10, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %10)
  br label %212

203:
  %204 = phi i64 [ 0, %200 ], [ %210, %203 ]
  %205 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %204
  %206 = load i64, ptr %205, align 16
  %207 = getelementptr inbounds double, ptr %196, i64 %206
  %208 = load double, ptr %207, align 8
  %209 = getelementptr inbounds [16 x double], ptr %10, i64 0, i64 %204
  store double %208, ptr %209, align 8
  %210 = add nuw nsw i64 %204, 1
  %211 = icmp eq i64 %210, 16
  br i1 %211, label %201, label %203

212:
  %213 = phi <16 x double> [ %199, %197 ], [ %202, %201 ]
  %214 = getelementptr inbounds %struct.Joint, ptr %185, i64 %194, i32 2
  %215 = load float, ptr %214, align 4
  %216 = fcmp contract une float %215, 0.000000e+00
  br i1 %216, label %223, label %217

217:
  %218 = fmul contract <16 x double> %213, <double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883, double 0x3FC45F306DC9C883>
  %219 = fadd contract <16 x double> %218, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %220 = fadd contract <16 x double> %219, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %221 = fmul contract <16 x double> %220, <double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18, double 0x401921FB54442D18>
  %222 = fsub contract <16 x double> %213, %221
  br label %223

223:
  %224 = phi contract <16 x double> [ %222, %217 ], [ %213, %212 ]
  %225 = fptrunc <16 x double> %224 to <16 x float>
  %226 = getelementptr inbounds [16 x <16 x float>], ptr %21, i64 0, i64 %194
  store <16 x float> %225, ptr %226, align 64
  %227 = getelementptr inbounds double, ptr %118, i64 %195
  br i1 %68, label %228, label %255

228:
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %9)
  br label %229

229:
  %230 = phi i64 [ 0, %228 ], [ %236, %229 ]
  %231 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %230
  %232 = load i64, ptr %231, align 16
  %233 = getelementptr inbounds double, ptr %227, i64 %232
  %234 = load double, ptr %233, align 8
  %235 = getelementptr inbounds [16 x double], ptr %9, i64 0, i64 %230
  store double %234, ptr %235, align 8
  %236 = add nuw nsw i64 %230, 1
  %237 = icmp eq i64 %236, 16
  br i1 %237, label %238, label %229

238:
  %239 = load <16 x double>, ptr %9, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %9)
  %240 = fsub contract <16 x double> %239, %213
  %241 = fptrunc <16 x double> %240 to <16 x float>
  %242 = getelementptr inbounds [16 x <16 x float>], ptr %23, i64 0, i64 %194
  store <16 x float> %241, ptr %242, align 64
  %243 = add nuw nsw i64 %194, %112
  %244 = mul nsw i64 %243, %120
  %245 = getelementptr inbounds double, ptr %157, i64 %244
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %8)
  br label %246

246:
  %247 = phi i64 [ 0, %238 ], [ %253, %246 ]
  %248 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %247
  %249 = load i64, ptr %248, align 16
  %250 = getelementptr inbounds double, ptr %245, i64 %249
  %251 = load double, ptr %250, align 8
  %252 = getelementptr inbounds [16 x double], ptr %8, i64 0, i64 %247
  store double %251, ptr %252, align 8
  %253 = add nuw nsw i64 %247, 1
  %254 = icmp eq i64 %253, 16
  br i1 %254, label %270, label %246

255:
  %256 = getelementptr inbounds double, ptr %227, i64 %184
  %257 = load <16 x double>, ptr %256, align 8
  %258 = fsub contract <16 x double> %257, %213
  %259 = fptrunc <16 x double> %258 to <16 x float>
  %260 = getelementptr inbounds [16 x <16 x float>], ptr %23, i64 0, i64 %194
  store <16 x float> %259, ptr %260, align 64
  %261 = add nuw nsw i64 %194, %112
  %262 = mul nsw i64 %261, %120
  %263 = getelementptr double, ptr %186, i64 %262
  %264 = load <16 x double>, ptr %263, align 8
  %265 = fmul contract <16 x double> %160, %264
  %266 = fptrunc <16 x double> %265 to <16 x float>
  %267 = getelementptr inbounds [16 x <16 x float>], ptr %22, i64 0, i64 %194
  store <16 x float> %266, ptr %267, align 64
  %268 = getelementptr double, ptr %187, i64 %262
  %269 = load <16 x double>, ptr %268, align 8
  br label %287

270:
  %271 = load <16 x double>, ptr %8, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %8)
  %272 = fmul contract <16 x double> %160, %271
  %273 = fptrunc <16 x double> %272 to <16 x float>
  %274 = getelementptr inbounds [16 x <16 x float>], ptr %22, i64 0, i64 %194
  store <16 x float> %273, ptr %274, align 64
  %275 = getelementptr inbounds double, ptr %118, i64 %244
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %7)
  br label %278

276:
  %277 = load <16 x double>, ptr %7, align 16
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %7)
  br label %287

278:
  %279 = phi i64 [ 0, %270 ], [ %285, %278 ]
  %280 = getelementptr inbounds %struct.SpanPiece, ptr %31, i64 %279
  %281 = load i64, ptr %280, align 16
  %282 = getelementptr inbounds double, ptr %275, i64 %281
  %283 = load double, ptr %282, align 8
  %284 = getelementptr inbounds [16 x double], ptr %7, i64 0, i64 %279
  store double %283, ptr %284, align 8
  %285 = add nuw nsw i64 %279, 1
  %286 = icmp eq i64 %285, 16
  br i1 %286, label %276, label %278

287:
  %288 = phi <16 x double> [ %269, %255 ], [ %277, %276 ]
  %289 = fmul contract <16 x double> %160, %288
  %290 = fptrunc <16 x double> %289 to <16 x float>
  %291 = getelementptr inbounds [16 x <16 x float>], ptr %24, i64 0, i64 %194
  store <16 x float> %290, ptr %291, align 64
  %292 = add nuw nsw i64 %194, 1
  %293 = icmp eq i64 %292, %112
  br i1 %293, label %188, label %193

294:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %27)
  br label %295

295:
  %296 = phi i64 [ 0, %294 ], [ %303, %295 ]
  %297 = and i64 %296, 3
  %298 = icmp eq i64 %297, 0
  %299 = uitofp i1 %298 to float
  %300 = insertelement <16 x float> poison, float %299, i64 0
  %301 = shufflevector <16 x float> %300, <16 x float> poison, <16 x i32> zeroinitializer
  %302 = getelementptr inbounds [9 x <16 x float>], ptr %27, i64 0, i64 %296
  store <16 x float> %301, ptr %302, align 64
  %303 = add nuw nsw i64 %296, 1
  %304 = icmp eq i64 %303, 9
  br i1 %304, label %309, label %295

305:
  br i1 %182, label %307, label %306

306:
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %28)
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %29)
  br label %579

307:
  %308 = load ptr, ptr %39, align 8
  br label %314

309:
  %310 = phi i64 [ %312, %309 ], [ 0, %295 ]
  %311 = getelementptr inbounds [3 x <16 x float>], ptr %40, i64 0, i64 %310
  store <16 x float> zeroinitializer, ptr %311, align 64
  %312 = add nuw nsw i64 %310, 1
  %313 = icmp eq i64 %312, 3
  br i1 %313, label %305, label %309

314:
  %315 = phi i64 [ 0, %307 ], [ %318, %502 ]
  %316 = getelementptr inbounds %struct.Joint, ptr %308, i64 %315
  %317 = getelementptr inbounds %struct.Frame, ptr %27, i64 %315
  %318 = add nuw nsw i64 %315, 1
  %319 = getelementptr inbounds <16 x float>, ptr %16, i64 %315
  %320 = load <16 x float>, ptr %319, align 64
  %321 = getelementptr inbounds i8, ptr %316, i64 36
  %322 = load float, ptr %321, align 4
  %323 = getelementptr inbounds i8, ptr %316, i64 40
  %324 = load float, ptr %323, align 4
  %325 = getelementptr inbounds i8, ptr %316, i64 44
  %326 = load float, ptr %325, align 4
  %327 = getelementptr inbounds i8, ptr %317, i64 576
  %328 = load <16 x float>, ptr %327, align 64
  %329 = load <16 x float>, ptr %317, align 64
  %330 = insertelement <16 x float> poison, float %322, i64 0
  %331 = shufflevector <16 x float> %330, <16 x float> poison, <16 x i32> zeroinitializer
  %332 = fmul contract <16 x float> %331, %329
  %333 = getelementptr inbounds i8, ptr %317, i64 64
  %334 = load <16 x float>, ptr %333, align 64
  %335 = insertelement <16 x float> poison, float %324, i64 0
  %336 = shufflevector <16 x float> %335, <16 x float> poison, <16 x i32> zeroinitializer
  %337 = fmul contract <16 x float> %336, %334
  %338 = getelementptr inbounds i8, ptr %317, i64 128
  %339 = load <16 x float>, ptr %338, align 64
  %340 = insertelement <16 x float> poison, float %326, i64 0
  %341 = shufflevector <16 x float> %340, <16 x float> poison, <16 x i32> zeroinitializer
  %342 = fmul contract <16 x float> %341, %339
  %343 = getelementptr inbounds i8, ptr %317, i64 640
  %344 = load <16 x float>, ptr %343, align 64
  %345 = getelementptr inbounds i8, ptr %317, i64 192
  %346 = load <16 x float>, ptr %345, align 64
  %347 = fmul contract <16 x float> %331, %346
  %348 = getelementptr inbounds i8, ptr %317, i64 256
  %349 = load <16 x float>, ptr %348, align 64
  %350 = fmul contract <16 x float> %336, %349
  %351 = getelementptr inbounds i8, ptr %317, i64 320
  %352 = load <16 x float>, ptr %351, align 64
  %353 = fmul contract <16 x float> %341, %352
  %354 = getelementptr inbounds i8, ptr %317, i64 704
  %355 = load <16 x float>, ptr %354, align 64
  %356 = getelementptr inbounds i8, ptr %317, i64 384
  %357 = load <16 x float>, ptr %356, align 64
  %358 = fmul contract <16 x float> %331, %357
  %359 = getelementptr inbounds i8, ptr %317, i64 448
  %360 = load <16 x float>, ptr %359, align 64
  %361 = fmul contract <16 x float> %336, %360
  %362 = getelementptr inbounds i8, ptr %317, i64 512
  %363 = load <16 x float>, ptr %362, align 64
  %364 = fmul contract <16 x float> %341, %363
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %15)
  br label %365

365:
  %366 = phi i64 [ 0, %314 ], [ %394, %393 ]
  %367 = mul nuw nsw i64 %366, 3
  %368 = getelementptr inbounds [9 x <16 x float>], ptr %317, i64 0, i64 %367
  %369 = load <16 x float>, ptr %368, align 64
  %370 = add nuw nsw i64 %367, 1
  %371 = getelementptr inbounds [9 x <16 x float>], ptr %317, i64 0, i64 %370
  %372 = load <16 x float>, ptr %371, align 64
  %373 = add nuw nsw i64 %367, 2
  %374 = getelementptr inbounds [9 x <16 x float>], ptr %317, i64 0, i64 %373
  %375 = load <16 x float>, ptr %374, align 64
  br label %396

376:
  %377 = getelementptr inbounds %struct.Frame, ptr %27, i64 %318
  %378 = fadd contract <16 x float> %328, %332
  %379 = fadd contract <16 x float> %378, %337
  %380 = fadd contract <16 x float> %379, %342
  %381 = fadd contract <16 x float> %344, %347
  %382 = fadd contract <16 x float> %381, %350
  %383 = fadd contract <16 x float> %382, %353
  %384 = fadd contract <16 x float> %355, %358
  %385 = fadd contract <16 x float> %384, %361
  %386 = fadd contract <16 x float> %385, %364
  %387 = getelementptr inbounds i8, ptr %377, i64 576
  store <16 x float> %380, ptr %387, align 64
  %388 = getelementptr inbounds i8, ptr %377, i64 640
  store <16 x float> %383, ptr %388, align 64
  %389 = getelementptr inbounds i8, ptr %377, i64 704
  store <16 x float> %386, ptr %389, align 64
  %390 = getelementptr inbounds i8, ptr %316, i64 48
  %391 = load float, ptr %390, align 4
  %392 = fcmp contract une float %391, 0.000000e+00
  br i1 %392, label %421, label %440

393:
  %394 = add nuw nsw i64 %366, 1
  %395 = icmp eq i64 %394, 3
  br i1 %395, label %376, label %365

396:
  %397 = phi i64 [ 0, %365 ], [ %419, %396 ]
  %398 = getelementptr inbounds [9 x float], ptr %316, i64 0, i64 %397
  %399 = load float, ptr %398, align 4
  %400 = insertelement <16 x float> poison, float %399, i64 0
  %401 = shufflevector <16 x float> %400, <16 x float> poison, <16 x i32> zeroinitializer
  %402 = fmul contract <16 x float> %369, %401
  %403 = add nuw nsw i64 %397, 3
  %404 = getelementptr inbounds [9 x float], ptr %316, i64 0, i64 %403
  %405 = load float, ptr %404, align 4
  %406 = insertelement <16 x float> poison, float %405, i64 0
  %407 = shufflevector <16 x float> %406, <16 x float> poison, <16 x i32> zeroinitializer
  %408 = fmul contract <16 x float> %372, %407
  %409 = fadd contract <16 x float> %402, %408
  %410 = add nuw nsw i64 %397, 6
  %411 = getelementptr inbounds [9 x float], ptr %316, i64 0, i64 %410
  %412 = load float, ptr %411, align 4
  %413 = insertelement <16 x float> poison, float %412, i64 0
  %414 = shufflevector <16 x float> %413, <16 x float> poison, <16 x i32> zeroinitializer
  %415 = fmul contract <16 x float> %375, %414
  %416 = fadd contract <16 x float> %409, %415
  %417 = add nuw nsw i64 %397, %367
  %418 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %417
  store <16 x float> %416, ptr %418, align 64
  %419 = add nuw nsw i64 %397, 1
  %420 = icmp eq i64 %419, 3
  br i1 %420, label %393, label %396

421:
  %422 = phi i64 [ %426, %421 ], [ 0, %376 ]
  %423 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %422
  %424 = load <16 x float>, ptr %423, align 64
  %425 = getelementptr inbounds [9 x <16 x float>], ptr %377, i64 0, i64 %422
  store <16 x float> %424, ptr %425, align 64
  %426 = add nuw nsw i64 %422, 1
  %427 = icmp eq i64 %426, 9
  br i1 %427, label %428, label %421

428:
  %429 = phi i64 [ %438, %428 ], [ 0, %421 ]
  %430 = mul nuw nsw i64 %429, 3
  %431 = add nuw nsw i64 %430, 2
  %432 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %431
  %433 = load <16 x float>, ptr %432, align 64
  %434 = fmul contract <16 x float> %320, %433
  %435 = getelementptr inbounds [3 x <16 x float>], ptr %387, i64 0, i64 %429
  %436 = load <16 x float>, ptr %435, align 64
  %437 = fadd contract <16 x float> %436, %434
  store <16 x float> %437, ptr %435, align 64
  %438 = add nuw nsw i64 %429, 1
  %439 = icmp eq i64 %438, 3
  br i1 %439, label %502, label %428

440:
  %441 = fmul contract <16 x float> %320, <float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000>
  %442 = fadd contract <16 x float> %441, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %443 = fadd contract <16 x float> %442, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %444 = fmul contract <16 x float> %443, <float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000>
  %445 = fsub contract <16 x float> %320, %444
  %446 = fmul contract <16 x float> %443, <float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000>
  %447 = fsub contract <16 x float> %445, %446
  %448 = fmul contract <16 x float> %443, <float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000>
  %449 = fsub contract <16 x float> %447, %448
  %450 = fmul contract <16 x float> %443, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %451 = fadd contract <16 x float> %450, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %452 = fadd contract <16 x float> %451, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %453 = fsub contract <16 x float> %450, %452
  %454 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %453)
  %455 = fmul contract <16 x float> %454, <float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00>
  %456 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %455
  %457 = fmul contract <16 x float> %449, %449
  %458 = fmul contract <16 x float> %449, %457
  %459 = fmul contract <16 x float> %457, <float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000>
  %460 = fadd contract <16 x float> %459, <float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000>
  %461 = fmul contract <16 x float> %457, %460
  %462 = fadd contract <16 x float> %461, <float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000>
  %463 = fmul contract <16 x float> %457, %462
  %464 = fadd contract <16 x float> %463, <float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000>
  %465 = fmul contract <16 x float> %458, %464
  %466 = fadd contract <16 x float> %449, %465
  %467 = fmul contract <16 x float> %456, %466
  %468 = fmul contract <16 x float> %457, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %469 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %468
  %470 = fmul contract <16 x float> %457, %457
  %471 = fmul contract <16 x float> %457, <float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000>
  %472 = fsub contract <16 x float> <float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000>, %471
  %473 = fmul contract <16 x float> %457, %472
  %474 = fadd contract <16 x float> %473, <float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000>
  %475 = fmul contract <16 x float> %457, %474
  %476 = fadd contract <16 x float> %475, <float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000>
  %477 = fmul contract <16 x float> %470, %476
  %478 = fadd contract <16 x float> %469, %477
  %479 = fmul contract <16 x float> %456, %478
  br label %480

480:
  %481 = phi i64 [ 0, %440 ], [ %500, %480 ]
  %482 = mul nuw nsw i64 %481, 3
  %483 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %482
  %484 = load <16 x float>, ptr %483, align 64
  %485 = fmul contract <16 x float> %479, %484
  %486 = add nuw nsw i64 %482, 1
  %487 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %486
  %488 = load <16 x float>, ptr %487, align 64
  %489 = fmul contract <16 x float> %467, %488
  %490 = fadd contract <16 x float> %485, %489
  %491 = getelementptr inbounds [9 x <16 x float>], ptr %377, i64 0, i64 %482
  store <16 x float> %490, ptr %491, align 64
  %492 = fmul contract <16 x float> %479, %488
  %493 = fmul contract <16 x float> %467, %484
  %494 = fsub contract <16 x float> %492, %493
  %495 = getelementptr inbounds [9 x <16 x float>], ptr %377, i64 0, i64 %486
  store <16 x float> %494, ptr %495, align 64
  %496 = add nuw nsw i64 %482, 2
  %497 = getelementptr inbounds [9 x <16 x float>], ptr %15, i64 0, i64 %496
  %498 = load <16 x float>, ptr %497, align 64
  %499 = getelementptr inbounds [9 x <16 x float>], ptr %377, i64 0, i64 %496
  store <16 x float> %498, ptr %499, align 64
  %500 = add nuw nsw i64 %481, 1
  %501 = icmp eq i64 %500, 3
  br i1 %501, label %502, label %480

502:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %15)
  %503 = icmp eq i64 %318, %112
  br i1 %503, label %504, label %314

504:
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %28)
  call void @llvm.lifetime.start.p0(i64 18496, ptr nonnull %29)
  br i1 %182, label %505, label %579

505:
  %506 = load ptr, ptr %39, align 8
  br label %597

507:
  %508 = phi i64 [ 0, %189 ], [ %577, %507 ]
  %509 = getelementptr inbounds [16 x <16 x float>], ptr %23, i64 0, i64 %508
  %510 = load <16 x float>, ptr %509, align 64
  %511 = fmul contract <16 x float> %510, <float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00, float 3.000000e+00>
  %512 = getelementptr inbounds [16 x <16 x float>], ptr %22, i64 0, i64 %508
  %513 = load <16 x float>, ptr %512, align 64
  %514 = fmul contract <16 x float> %513, <float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00>
  %515 = fsub contract <16 x float> %511, %514
  %516 = getelementptr inbounds [16 x <16 x float>], ptr %24, i64 0, i64 %508
  %517 = load <16 x float>, ptr %516, align 64
  %518 = fsub contract <16 x float> %515, %517
  %519 = fadd contract <16 x float> %513, %517
  %520 = fmul contract <16 x float> %510, <float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00>
  %521 = fsub contract <16 x float> %519, %520
  %522 = fmul contract <16 x float> %115, %521
  %523 = fadd contract <16 x float> %518, %522
  %524 = fmul contract <16 x float> %115, %523
  %525 = fadd contract <16 x float> %513, %524
  %526 = fmul contract <16 x float> %115, %525
  %527 = fmul contract <16 x float> %116, %521
  %528 = fadd contract <16 x float> %518, %527
  %529 = fmul contract <16 x float> %116, %528
  %530 = fadd contract <16 x float> %513, %529
  %531 = fmul contract <16 x float> %116, %530
  %532 = fmul contract <16 x float> %518, <float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00, float 2.000000e+00>
  %533 = fmul contract <16 x float> %190, %521
  %534 = fadd contract <16 x float> %532, %533
  %535 = fmul contract <16 x float> %115, %534
  %536 = fadd contract <16 x float> %513, %535
  %537 = fmul contract <16 x float> %191, %521
  %538 = fadd contract <16 x float> %532, %537
  %539 = fmul contract <16 x float> %116, %538
  %540 = fadd contract <16 x float> %513, %539
  %541 = fadd contract <16 x float> %518, %533
  %542 = fmul contract <16 x float> %117, %541
  %543 = fadd contract <16 x float> %542, %536
  %544 = fmul contract <16 x float> %192, %536
  %545 = fadd contract <16 x float> %526, %544
  %546 = fmul contract <16 x float> %192, %540
  %547 = fsub contract <16 x float> %531, %546
  %548 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %536)
  %549 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %543)
  %550 = fcmp contract ogt <16 x float> %548, %549
  %551 = select contract <16 x i1> %550, <16 x float> %548, <16 x float> %549
  %552 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %540)
  %553 = fcmp contract ogt <16 x float> %551, %552
  %554 = select contract <16 x i1> %553, <16 x float> %551, <16 x float> %552
  %555 = getelementptr inbounds [16 x <16 x float>], ptr %18, i64 0, i64 %508
  store <16 x float> %554, ptr %555, align 64
  %556 = fcmp contract olt <16 x float> %526, %545
  %557 = select contract <16 x i1> %556, <16 x float> %526, <16 x float> %545
  %558 = fcmp contract olt <16 x float> %547, %531
  %559 = select contract <16 x i1> %558, <16 x float> %547, <16 x float> %531
  %560 = fcmp contract olt <16 x float> %557, %559
  %561 = select contract <16 x i1> %560, <16 x float> %557, <16 x float> %559
  %562 = fcmp contract ogt <16 x float> %526, %545
  %563 = select contract <16 x i1> %562, <16 x float> %526, <16 x float> %545
  %564 = fcmp contract ogt <16 x float> %547, %531
  %565 = select contract <16 x i1> %564, <16 x float> %547, <16 x float> %531
  %566 = fcmp contract ogt <16 x float> %563, %565
  %567 = select contract <16 x i1> %566, <16 x float> %563, <16 x float> %565
  %568 = getelementptr inbounds [16 x <16 x float>], ptr %21, i64 0, i64 %508
  %569 = load <16 x float>, ptr %568, align 64
  %570 = fadd contract <16 x float> %561, %567
  %571 = fmul contract <16 x float> %570, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %572 = fadd contract <16 x float> %569, %571
  %573 = getelementptr inbounds [16 x <16 x float>], ptr %16, i64 0, i64 %508
  store <16 x float> %572, ptr %573, align 64
  %574 = fsub contract <16 x float> %567, %561
  %575 = fmul contract <16 x float> %574, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %576 = getelementptr inbounds [16 x <16 x float>], ptr %17, i64 0, i64 %508
  store <16 x float> %575, ptr %576, align 64
  %577 = add nuw nsw i64 %508, 1
  %578 = icmp eq i64 %577, %112
  br i1 %578, label %294, label %507

579:
  %580 = phi <16 x float> [ zeroinitializer, %504 ], [ zeroinitializer, %306 ], [ %612, %611 ]
  %581 = phi <16 x float> [ zeroinitializer, %504 ], [ zeroinitializer, %306 ], [ %613, %611 ]
  %582 = fcmp contract oeq <16 x float> %117, zeroinitializer
  %583 = load float, ptr %41, align 8
  %584 = insertelement <16 x float> poison, float %583, i64 0
  %585 = shufflevector <16 x float> %584, <16 x float> poison, <16 x i32> zeroinitializer
  %586 = fneg contract <16 x float> %585
  %587 = select <16 x i1> %582, <16 x float> %586, <16 x float> %585
  %588 = fadd contract <16 x float> %587, zeroinitializer
  %589 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %581
  %590 = fcmp contract ogt <16 x float> %589, <float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000>
  %591 = select contract <16 x i1> %590, <16 x float> %589, <16 x float> <float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000, float 0x3EB0C6F7A0000000>
  %592 = fdiv contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %591
  %593 = icmp slt i64 %112, 1
  br i1 %593, label %616, label %594

594:
  %595 = load ptr, ptr %42, align 8
  %596 = load ptr, ptr %39, align 8
  br label %621

597:
  %598 = phi <16 x float> [ zeroinitializer, %505 ], [ %613, %611 ]
  %599 = phi i64 [ 0, %505 ], [ %614, %611 ]
  %600 = phi <16 x float> [ zeroinitializer, %505 ], [ %612, %611 ]
  %601 = getelementptr inbounds %struct.Joint, ptr %506, i64 %599, i32 2
  %602 = load float, ptr %601, align 4
  %603 = fcmp contract oeq float %602, 0.000000e+00
  br i1 %603, label %604, label %611

604:
  %605 = getelementptr inbounds [16 x <16 x float>], ptr %17, i64 0, i64 %599
  %606 = load <16 x float>, ptr %605, align 64
  %607 = fadd contract <16 x float> %598, %606
  %608 = getelementptr inbounds [16 x <16 x float>], ptr %18, i64 0, i64 %599
  %609 = load <16 x float>, ptr %608, align 64
  %610 = fadd contract <16 x float> %600, %609
  br label %611

611:
  %612 = phi <16 x float> [ %610, %604 ], [ %600, %597 ]
  %613 = phi <16 x float> [ %607, %604 ], [ %598, %597 ]
  %614 = add nuw nsw i64 %599, 1
  %615 = icmp eq i64 %614, %112
  br i1 %615, label %579, label %597

616:
  %617 = load i64, ptr %43, align 8
  %618 = icmp sgt i64 %617, 0
  br i1 %618, label %619, label %743

619:
  %620 = load ptr, ptr %44, align 8
  br label %744

621:
  %622 = phi i64 [ 1, %594 ], [ %688, %683 ]
  %623 = getelementptr inbounds %struct.Sphere, ptr %595, i64 %622
  %624 = getelementptr inbounds [17 x %struct.Frame], ptr %27, i64 0, i64 %622
  %625 = load float, ptr %623, align 4
  %626 = getelementptr inbounds i8, ptr %623, i64 4
  %627 = load float, ptr %626, align 4
  %628 = getelementptr inbounds i8, ptr %623, i64 8
  %629 = load float, ptr %628, align 4
  %630 = getelementptr inbounds i8, ptr %624, i64 576
  %631 = load <16 x float>, ptr %630, align 64
  %632 = load <16 x float>, ptr %624, align 64
  %633 = insertelement <16 x float> poison, float %625, i64 0
  %634 = shufflevector <16 x float> %633, <16 x float> poison, <16 x i32> zeroinitializer
  %635 = fmul contract <16 x float> %634, %632
  %636 = fadd contract <16 x float> %631, %635
  %637 = getelementptr inbounds i8, ptr %624, i64 64
  %638 = load <16 x float>, ptr %637, align 64
  %639 = insertelement <16 x float> poison, float %627, i64 0
  %640 = shufflevector <16 x float> %639, <16 x float> poison, <16 x i32> zeroinitializer
  %641 = fmul contract <16 x float> %640, %638
  %642 = fadd contract <16 x float> %636, %641
  %643 = getelementptr inbounds i8, ptr %624, i64 128
  %644 = load <16 x float>, ptr %643, align 64
  %645 = insertelement <16 x float> poison, float %629, i64 0
  %646 = shufflevector <16 x float> %645, <16 x float> poison, <16 x i32> zeroinitializer
  %647 = fmul contract <16 x float> %646, %644
  %648 = fadd contract <16 x float> %642, %647
  %649 = getelementptr inbounds i8, ptr %624, i64 640
  %650 = load <16 x float>, ptr %649, align 64
  %651 = getelementptr inbounds i8, ptr %624, i64 192
  %652 = load <16 x float>, ptr %651, align 64
  %653 = fmul contract <16 x float> %634, %652
  %654 = fadd contract <16 x float> %650, %653
  %655 = getelementptr inbounds i8, ptr %624, i64 256
  %656 = load <16 x float>, ptr %655, align 64
  %657 = fmul contract <16 x float> %640, %656
  %658 = fadd contract <16 x float> %654, %657
  %659 = getelementptr inbounds i8, ptr %624, i64 320
  %660 = load <16 x float>, ptr %659, align 64
  %661 = fmul contract <16 x float> %646, %660
  %662 = fadd contract <16 x float> %658, %661
  %663 = getelementptr inbounds i8, ptr %624, i64 704
  %664 = load <16 x float>, ptr %663, align 64
  %665 = getelementptr inbounds i8, ptr %624, i64 384
  %666 = load <16 x float>, ptr %665, align 64
  %667 = fmul contract <16 x float> %634, %666
  %668 = fadd contract <16 x float> %664, %667
  %669 = getelementptr inbounds i8, ptr %624, i64 448
  %670 = load <16 x float>, ptr %669, align 64
  %671 = fmul contract <16 x float> %640, %670
  %672 = fadd contract <16 x float> %668, %671
  %673 = getelementptr inbounds i8, ptr %624, i64 512
  %674 = load <16 x float>, ptr %673, align 64
  %675 = fmul contract <16 x float> %646, %674
  %676 = fadd contract <16 x float> %672, %675
  %677 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %622, i64 %622
  store <16 x float> zeroinitializer, ptr %677, align 64
  %678 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %622, i64 %622
  store <16 x float> zeroinitializer, ptr %678, align 64
  %679 = getelementptr inbounds i8, ptr %623, i64 12
  %680 = load float, ptr %679, align 4
  %681 = insertelement <16 x float> poison, float %680, i64 0
  %682 = shufflevector <16 x float> %681, <16 x float> poison, <16 x i32> zeroinitializer
  br label %690

683:
  %684 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %622
  %685 = load <16 x float>, ptr %684, align 64
  %686 = fadd contract <16 x float> %588, %685
  %687 = getelementptr inbounds [17 x <16 x float>], ptr %19, i64 0, i64 %622
  store <16 x float> %686, ptr %687, align 64
  %688 = add nuw i64 %622, 1
  %689 = icmp eq i64 %622, %112
  br i1 %689, label %616, label %621

690:
  %691 = phi <16 x float> [ zeroinitializer, %621 ], [ %740, %690 ]
  %692 = phi <16 x float> [ zeroinitializer, %621 ], [ %735, %690 ]
  %693 = phi i64 [ %622, %621 ], [ %694, %690 ]
  %694 = add nsw i64 %693, -1
  %695 = getelementptr inbounds [17 x %struct.Frame], ptr %27, i64 0, i64 %693
  %696 = getelementptr inbounds i8, ptr %695, i64 576
  %697 = load <16 x float>, ptr %696, align 64
  %698 = fsub contract <16 x float> %648, %697
  %699 = getelementptr inbounds i8, ptr %695, i64 640
  %700 = load <16 x float>, ptr %699, align 64
  %701 = fsub contract <16 x float> %662, %700
  %702 = getelementptr inbounds i8, ptr %695, i64 704
  %703 = load <16 x float>, ptr %702, align 64
  %704 = fsub contract <16 x float> %676, %703
  %705 = getelementptr inbounds i8, ptr %695, i64 128
  %706 = load <16 x float>, ptr %705, align 64
  %707 = fmul contract <16 x float> %698, %706
  %708 = getelementptr inbounds i8, ptr %695, i64 320
  %709 = load <16 x float>, ptr %708, align 64
  %710 = fmul contract <16 x float> %701, %709
  %711 = fadd contract <16 x float> %707, %710
  %712 = getelementptr inbounds i8, ptr %695, i64 512
  %713 = load <16 x float>, ptr %712, align 64
  %714 = fmul contract <16 x float> %704, %713
  %715 = fadd contract <16 x float> %711, %714
  %716 = fmul contract <16 x float> %698, %698
  %717 = fmul contract <16 x float> %701, %701
  %718 = fadd contract <16 x float> %716, %717
  %719 = fmul contract <16 x float> %704, %704
  %720 = fadd contract <16 x float> %718, %719
  %721 = fmul contract <16 x float> %715, %715
  %722 = fsub contract <16 x float> %720, %721
  %723 = fcmp contract ogt <16 x float> %722, zeroinitializer
  %724 = select contract <16 x i1> %723, <16 x float> %722, <16 x float> zeroinitializer
  %725 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %724)
  %726 = fadd contract <16 x float> %682, %725
  %727 = getelementptr inbounds %struct.Joint, ptr %596, i64 %694, i32 2
  %728 = load float, ptr %727, align 4
  %729 = fcmp contract une float %728, 0.000000e+00
  %730 = select i1 %729, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> %726
  %731 = getelementptr inbounds [16 x <16 x float>], ptr %17, i64 0, i64 %694
  %732 = load <16 x float>, ptr %731, align 64
  %733 = fmul contract <16 x float> %592, %732
  %734 = fmul contract <16 x float> %733, %730
  %735 = fadd contract <16 x float> %692, %734
  %736 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %622, i64 %694
  store <16 x float> %735, ptr %736, align 64
  %737 = getelementptr inbounds [16 x <16 x float>], ptr %18, i64 0, i64 %694
  %738 = load <16 x float>, ptr %737, align 64
  %739 = fmul contract <16 x float> %738, %730
  %740 = fadd contract <16 x float> %691, %739
  %741 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %622, i64 %694
  store <16 x float> %740, ptr %741, align 64
  %742 = icmp sgt i64 %693, 1
  br i1 %742, label %690, label %683

743:
  br i1 %593, label %758, label %763

744:
  %745 = phi i64 [ 0, %619 ], [ %754, %744 ]
  %746 = getelementptr inbounds %struct.LinkPair, ptr %620, i64 %745
  %747 = getelementptr inbounds i8, ptr %746, i64 8
  %748 = load i64, ptr %747, align 8
  %749 = load i64, ptr %746, align 8
  %750 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %748, i64 %749
  %751 = load <16 x float>, ptr %750, align 64
  %752 = fadd contract <16 x float> %588, %751
  %753 = getelementptr inbounds [136 x <16 x float>], ptr %20, i64 0, i64 %745
  store <16 x float> %752, ptr %753, align 64
  %754 = add nuw nsw i64 %745, 1
  %755 = icmp eq i64 %754, %617
  br i1 %755, label %743, label %744

756:
  %757 = load i64, ptr %43, align 8
  br label %758

758:
  %759 = phi i64 [ %617, %743 ], [ %757, %756 ]
  %760 = phi i64 [ %64, %743 ], [ %1173, %756 ]
  %761 = phi <16 x i32> [ zeroinitializer, %743 ], [ %1174, %756 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %13)
  %762 = icmp sgt i64 %759, 0
  br i1 %762, label %1177, label %1766

763:
  %764 = phi i64 [ %1172, %1171 ], [ %112, %743 ]
  %765 = phi <16 x i32> [ %1174, %1171 ], [ zeroinitializer, %743 ]
  %766 = phi i64 [ %1175, %1171 ], [ 1, %743 ]
  %767 = phi i64 [ %1173, %1171 ], [ %64, %743 ]
  %768 = load ptr, ptr %45, align 8
  %769 = getelementptr inbounds %struct.Sphere, ptr %768, i64 %766
  %770 = getelementptr inbounds i8, ptr %769, i64 12
  %771 = load float, ptr %770, align 4
  %772 = fcmp contract olt float %771, 0.000000e+00
  br i1 %772, label %1171, label %773

773:
  %774 = getelementptr inbounds %struct.Frame, ptr %27, i64 %766
  %775 = load float, ptr %769, align 4
  %776 = getelementptr inbounds i8, ptr %769, i64 4
  %777 = load float, ptr %776, align 4
  %778 = getelementptr inbounds i8, ptr %769, i64 8
  %779 = load float, ptr %778, align 4
  %780 = getelementptr inbounds i8, ptr %774, i64 576
  %781 = load <16 x float>, ptr %780, align 64
  %782 = load <16 x float>, ptr %774, align 64
  %783 = insertelement <16 x float> poison, float %775, i64 0
  %784 = shufflevector <16 x float> %783, <16 x float> poison, <16 x i32> zeroinitializer
  %785 = fmul contract <16 x float> %784, %782
  %786 = fadd contract <16 x float> %781, %785
  %787 = getelementptr inbounds i8, ptr %774, i64 64
  %788 = load <16 x float>, ptr %787, align 64
  %789 = insertelement <16 x float> poison, float %777, i64 0
  %790 = shufflevector <16 x float> %789, <16 x float> poison, <16 x i32> zeroinitializer
  %791 = fmul contract <16 x float> %790, %788
  %792 = fadd contract <16 x float> %786, %791
  %793 = getelementptr inbounds i8, ptr %774, i64 128
  %794 = load <16 x float>, ptr %793, align 64
  %795 = insertelement <16 x float> poison, float %779, i64 0
  %796 = shufflevector <16 x float> %795, <16 x float> poison, <16 x i32> zeroinitializer
  %797 = fmul contract <16 x float> %796, %794
  %798 = fadd contract <16 x float> %792, %797
  %799 = getelementptr inbounds i8, ptr %774, i64 640
  %800 = load <16 x float>, ptr %799, align 64
  %801 = getelementptr inbounds i8, ptr %774, i64 192
  %802 = load <16 x float>, ptr %801, align 64
  %803 = fmul contract <16 x float> %784, %802
  %804 = fadd contract <16 x float> %800, %803
  %805 = getelementptr inbounds i8, ptr %774, i64 256
  %806 = load <16 x float>, ptr %805, align 64
  %807 = fmul contract <16 x float> %790, %806
  %808 = fadd contract <16 x float> %804, %807
  %809 = getelementptr inbounds i8, ptr %774, i64 320
  %810 = load <16 x float>, ptr %809, align 64
  %811 = fmul contract <16 x float> %796, %810
  %812 = fadd contract <16 x float> %808, %811
  %813 = getelementptr inbounds i8, ptr %774, i64 704
  %814 = load <16 x float>, ptr %813, align 64
  %815 = getelementptr inbounds i8, ptr %774, i64 384
  %816 = load <16 x float>, ptr %815, align 64
  %817 = fmul contract <16 x float> %784, %816
  %818 = fadd contract <16 x float> %814, %817
  %819 = getelementptr inbounds i8, ptr %774, i64 448
  %820 = load <16 x float>, ptr %819, align 64
  %821 = fmul contract <16 x float> %790, %820
  %822 = fadd contract <16 x float> %818, %821
  %823 = getelementptr inbounds i8, ptr %774, i64 512
  %824 = load <16 x float>, ptr %823, align 64
  %825 = fmul contract <16 x float> %796, %824
  %826 = fadd contract <16 x float> %822, %825
  %827 = getelementptr inbounds <16 x float>, ptr %19, i64 %766
  %828 = load <16 x float>, ptr %827, align 64
  %829 = load i64, ptr %46, align 8
  %830 = icmp sgt i64 %829, 0
  br i1 %830, label %831, label %1171

831:
  %832 = add nsw i64 %766, -1
  %833 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %766, i64 0
  %834 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %766, i64 0
  br label %835

835:
  %836 = phi i64 [ %829, %831 ], [ %1164, %1163 ]
  %837 = phi <16 x i32> [ %765, %831 ], [ %1166, %1163 ]
  %838 = phi i64 [ 0, %831 ], [ %1167, %1163 ]
  %839 = phi i64 [ %767, %831 ], [ %1165, %1163 ]
  %840 = load ptr, ptr %47, align 8
  %841 = getelementptr inbounds %struct.Object, ptr %840, i64 %838
  %842 = load ptr, ptr %48, align 8
  %843 = mul nsw i64 %836, %766
  %844 = getelementptr float, ptr %842, i64 %843
  %845 = getelementptr float, ptr %844, i64 %838
  %846 = load float, ptr %845, align 4
  %847 = getelementptr inbounds i8, ptr %841, i64 60
  %848 = load float, ptr %847, align 4
  %849 = fadd contract float %846, %848
  %850 = fcmp contract olt float %849, -1.000000e+08
  br i1 %850, label %1163, label %851

851:
  %852 = load float, ptr %770, align 4
  %853 = fadd contract float %849, %852
  %854 = insertelement <16 x float> poison, float %853, i64 0
  %855 = shufflevector <16 x float> %854, <16 x float> poison, <16 x i32> zeroinitializer
  %856 = fadd contract <16 x float> %828, %855
  %857 = fcmp contract ogt <16 x float> %856, zeroinitializer
  %858 = select contract <16 x i1> %857, <16 x float> %856, <16 x float> zeroinitializer
  %859 = getelementptr inbounds i8, ptr %841, i64 36
  %860 = load float, ptr %859, align 4
  %861 = insertelement <16 x float> poison, float %860, i64 0
  %862 = shufflevector <16 x float> %861, <16 x float> poison, <16 x i32> zeroinitializer
  %863 = load float, ptr %841, align 4
  %864 = insertelement <16 x float> poison, float %863, i64 0
  %865 = shufflevector <16 x float> %864, <16 x float> poison, <16 x i32> zeroinitializer
  %866 = fmul contract <16 x float> %798, %865
  %867 = fadd contract <16 x float> %862, %866
  %868 = getelementptr inbounds i8, ptr %841, i64 4
  %869 = load float, ptr %868, align 4
  %870 = insertelement <16 x float> poison, float %869, i64 0
  %871 = shufflevector <16 x float> %870, <16 x float> poison, <16 x i32> zeroinitializer
  %872 = fmul contract <16 x float> %812, %871
  %873 = fadd contract <16 x float> %867, %872
  %874 = getelementptr inbounds i8, ptr %841, i64 8
  %875 = load float, ptr %874, align 4
  %876 = insertelement <16 x float> poison, float %875, i64 0
  %877 = shufflevector <16 x float> %876, <16 x float> poison, <16 x i32> zeroinitializer
  %878 = fmul contract <16 x float> %826, %877
  %879 = fadd contract <16 x float> %873, %878
  %880 = getelementptr inbounds i8, ptr %841, i64 40
  %881 = load float, ptr %880, align 4
  %882 = insertelement <16 x float> poison, float %881, i64 0
  %883 = shufflevector <16 x float> %882, <16 x float> poison, <16 x i32> zeroinitializer
  %884 = getelementptr inbounds i8, ptr %841, i64 12
  %885 = load float, ptr %884, align 4
  %886 = insertelement <16 x float> poison, float %885, i64 0
  %887 = shufflevector <16 x float> %886, <16 x float> poison, <16 x i32> zeroinitializer
  %888 = fmul contract <16 x float> %798, %887
  %889 = fadd contract <16 x float> %883, %888
  %890 = getelementptr inbounds i8, ptr %841, i64 16
  %891 = load float, ptr %890, align 4
  %892 = insertelement <16 x float> poison, float %891, i64 0
  %893 = shufflevector <16 x float> %892, <16 x float> poison, <16 x i32> zeroinitializer
  %894 = fmul contract <16 x float> %812, %893
  %895 = fadd contract <16 x float> %889, %894
  %896 = getelementptr inbounds i8, ptr %841, i64 20
  %897 = load float, ptr %896, align 4
  %898 = insertelement <16 x float> poison, float %897, i64 0
  %899 = shufflevector <16 x float> %898, <16 x float> poison, <16 x i32> zeroinitializer
  %900 = fmul contract <16 x float> %826, %899
  %901 = fadd contract <16 x float> %895, %900
  %902 = getelementptr inbounds i8, ptr %841, i64 44
  %903 = load float, ptr %902, align 4
  %904 = insertelement <16 x float> poison, float %903, i64 0
  %905 = shufflevector <16 x float> %904, <16 x float> poison, <16 x i32> zeroinitializer
  %906 = getelementptr inbounds i8, ptr %841, i64 24
  %907 = load float, ptr %906, align 4
  %908 = insertelement <16 x float> poison, float %907, i64 0
  %909 = shufflevector <16 x float> %908, <16 x float> poison, <16 x i32> zeroinitializer
  %910 = fmul contract <16 x float> %798, %909
  %911 = fadd contract <16 x float> %905, %910
  %912 = getelementptr inbounds i8, ptr %841, i64 28
  %913 = load float, ptr %912, align 4
  %914 = insertelement <16 x float> poison, float %913, i64 0
  %915 = shufflevector <16 x float> %914, <16 x float> poison, <16 x i32> zeroinitializer
  %916 = fmul contract <16 x float> %812, %915
  %917 = fadd contract <16 x float> %911, %916
  %918 = getelementptr inbounds i8, ptr %841, i64 32
  %919 = load float, ptr %918, align 4
  %920 = insertelement <16 x float> poison, float %919, i64 0
  %921 = shufflevector <16 x float> %920, <16 x float> poison, <16 x i32> zeroinitializer
  %922 = fmul contract <16 x float> %826, %921
  %923 = fadd contract <16 x float> %917, %922
  %924 = fmul contract <16 x float> %879, zeroinitializer
  %925 = getelementptr inbounds i8, ptr %841, i64 68
  %926 = load float, ptr %925, align 4
  %927 = fcmp contract une float %926, 0.000000e+00
  %928 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %923)
  %929 = select contract i1 %927, <16 x float> %923, <16 x float> %928
  %930 = getelementptr inbounds i8, ptr %841, i64 64
  %931 = load float, ptr %930, align 4
  %932 = fcmp contract une float %931, 0.000000e+00
  br i1 %932, label %933, label %938

933:
  %934 = fmul contract <16 x float> %879, %879
  %935 = fmul contract <16 x float> %901, %901
  %936 = fadd contract <16 x float> %934, %935
  %937 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %936)
  br label %940

938:
  %939 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %879)
  br label %940

940:
  %941 = phi contract <16 x float> [ %937, %933 ], [ %939, %938 ]
  %942 = getelementptr inbounds i8, ptr %841, i64 48
  %943 = load float, ptr %942, align 4
  %944 = insertelement <16 x float> poison, float %943, i64 0
  %945 = shufflevector <16 x float> %944, <16 x float> poison, <16 x i32> zeroinitializer
  %946 = fsub contract <16 x float> %941, %945
  %947 = fcmp contract ogt <16 x float> %946, %924
  %948 = select contract <16 x i1> %947, <16 x float> %946, <16 x float> %924
  %949 = getelementptr inbounds i8, ptr %841, i64 56
  %950 = load float, ptr %949, align 4
  %951 = insertelement <16 x float> poison, float %950, i64 0
  %952 = shufflevector <16 x float> %951, <16 x float> poison, <16 x i32> zeroinitializer
  %953 = fsub contract <16 x float> %929, %952
  %954 = fcmp contract ogt <16 x float> %953, %924
  %955 = select contract <16 x i1> %954, <16 x float> %953, <16 x float> %924
  %956 = fmul contract <16 x float> %948, %948
  %957 = fmul contract <16 x float> %955, %955
  %958 = fadd contract <16 x float> %956, %957
  br i1 %932, label %970, label %959

959:
  %960 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %901)
  %961 = getelementptr inbounds i8, ptr %841, i64 52
  %962 = load float, ptr %961, align 4
  %963 = insertelement <16 x float> poison, float %962, i64 0
  %964 = shufflevector <16 x float> %963, <16 x float> poison, <16 x i32> zeroinitializer
  %965 = fsub contract <16 x float> %960, %964
  %966 = fcmp contract ogt <16 x float> %965, %924
  %967 = select contract <16 x i1> %966, <16 x float> %965, <16 x float> %924
  %968 = fmul contract <16 x float> %967, %967
  %969 = fadd contract <16 x float> %958, %968
  br label %970

970:
  %971 = phi <16 x float> [ %969, %959 ], [ %958, %940 ]
  %972 = fmul contract <16 x float> %858, %858
  %973 = fcmp contract olt <16 x float> %971, %972
  %974 = bitcast <16 x i1> %973 to i16
  %975 = icmp eq i16 %974, 0
  br i1 %975, label %1163, label %976

976:
  %977 = load ptr, ptr %49, align 8
  %978 = getelementptr inbounds i64, ptr %977, i64 %766
  %979 = load i64, ptr %978, align 8
  %980 = getelementptr inbounds i8, ptr %978, i64 8
  %981 = load i64, ptr %980, align 8
  %982 = icmp slt i64 %979, %981
  br i1 %982, label %983, label %986

983:
  %984 = load ptr, ptr %50, align 8
  %985 = getelementptr inbounds i8, ptr %841, i64 52
  br label %1064

986:
  %987 = phi <16 x i32> [ zeroinitializer, %976 ], [ %1158, %1154 ]
  %988 = or <16 x i32> %987, %837
  %989 = mul nsw i64 %836, %832
  %990 = add nsw i64 %989, %838
  %991 = icmp ne <16 x i32> %987, zeroinitializer
  %992 = bitcast <16 x i1> %991 to i16
  %993 = zext i16 %992 to i64
  %994 = and i64 %181, %993
  %995 = icmp eq i64 %994, 0
  br i1 %995, label %1163, label %996

996:
  %997 = load <16 x float>, ptr %833, align 64
  %998 = load <16 x float>, ptr %834, align 64
  %999 = and i64 %994, %111
  %1000 = icmp eq i64 %999, 0
  br i1 %1000, label %1163, label %1001

1001:
  %1002 = phi i64 [ %1060, %1059 ], [ %839, %996 ]
  %1003 = phi i64 [ %1062, %1059 ], [ %999, %996 ]
  %1004 = tail call range(i64 0, 65) i64 @llvm.cttz.i64(i64 %1003, i1 true)
  %1005 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1004
  %1006 = getelementptr inbounds i8, ptr %1005, i64 8
  %1007 = load float, ptr %1006, align 8
  %1008 = getelementptr inbounds i8, ptr %1005, i64 12
  %1009 = load float, ptr %1008, align 4
  %1010 = fcmp contract une float %1007, %1009
  br i1 %1010, label %1011, label %1059

1011:
  %1012 = load i64, ptr %1005, align 16
  %1013 = extractelement <16 x float> %997, i64 %1004
  %1014 = extractelement <16 x float> %998, i64 %1004
  %1015 = extractelement <16 x float> %580, i64 %1004
  %1016 = fmul contract float %1014, %1015
  %1017 = fadd contract float %1013, %1016
  %1018 = fpext float %1017 to double
  %1019 = fmul contract double %1018, 1.001000e+00
  %1020 = icmp sle i64 %1002, %4
  %1021 = icmp sgt i64 %1002, 0
  %1022 = and i1 %1020, %1021
  br i1 %1022, label %1023, label %1047

1023:
  %1024 = tail call i64 @llvm.umax.i64(i64 %1002, i64 64)
  %1025 = add nsw i64 %1024, -63
  br label %1026

1026:
  %1027 = phi i64 [ %1028, %1045 ], [ %1002, %1023 ]
  %1028 = add nsw i64 %1027, -1
  %1029 = getelementptr inbounds %struct.Contact, ptr %3, i64 %1028
  %1030 = getelementptr inbounds i8, ptr %1029, i64 16
  %1031 = load i64, ptr %1030, align 8
  %1032 = icmp eq i64 %1031, %990
  br i1 %1032, label %1033, label %1045

1033:
  %1034 = load i64, ptr %1029, align 8
  %1035 = icmp eq i64 %1034, %1012
  br i1 %1035, label %1036, label %1045

1036:
  %1037 = getelementptr inbounds i8, ptr %1029, i64 12
  %1038 = load float, ptr %1037, align 4
  %1039 = fcmp contract une float %1038, %1007
  br i1 %1039, label %1045, label %1040

1040:
  %1041 = getelementptr inbounds i8, ptr %1029, i64 12
  store float %1009, ptr %1041, align 4
  %1042 = getelementptr inbounds i8, ptr %1029, i64 24
  %1043 = load double, ptr %1042, align 8
  %1044 = fcmp contract ogt double %1019, %1043
  br i1 %1044, label %1056, label %1059

1045:
  %1046 = icmp sgt i64 %1027, %1025
  br i1 %1046, label %1026, label %1047

1047:
  %1048 = add i64 %1002, 1
  %1049 = icmp slt i64 %1002, %4
  br i1 %1049, label %1050, label %1059

1050:
  %1051 = getelementptr inbounds %struct.Contact, ptr %3, i64 %1002
  store i64 %1012, ptr %1051, align 8
  %1052 = getelementptr inbounds i8, ptr %1051, i64 8
  store float %1007, ptr %1052, align 8
  %1053 = getelementptr inbounds i8, ptr %1051, i64 12
  store float %1009, ptr %1053, align 4
  %1054 = getelementptr inbounds i8, ptr %1051, i64 16
  store i64 %990, ptr %1054, align 8
  %1055 = getelementptr inbounds i8, ptr %1051, i64 24
  br label %1056

1056:
  %1057 = phi i64 [ %1048, %1050 ], [ %1002, %1040 ]
  %1058 = phi ptr [ %1055, %1050 ], [ %1042, %1040 ]
  store double %1019, ptr %1058, align 8
  br label %1059

1059:
  %1060 = phi i64 [ %1057, %1056 ], [ %1048, %1047 ], [ %1002, %1040 ], [ %1002, %1001 ]
  %1061 = add nsw i64 %1003, -1
  %1062 = and i64 %1061, %1003
  %1063 = icmp eq i64 %1062, 0
  br i1 %1063, label %1161, label %1001

1064:
  %1065 = phi <16 x i32> [ zeroinitializer, %983 ], [ %1158, %1154 ]
  %1066 = phi i64 [ %979, %983 ], [ %1159, %1154 ]
  %1067 = getelementptr inbounds %struct.Sphere, ptr %984, i64 %1066
  %1068 = getelementptr inbounds i8, ptr %1067, i64 12
  %1069 = load float, ptr %1068, align 4
  %1070 = fadd contract float %849, %1069
  %1071 = insertelement <16 x float> poison, float %1070, i64 0
  %1072 = shufflevector <16 x float> %1071, <16 x float> poison, <16 x i32> zeroinitializer
  %1073 = fadd contract <16 x float> %828, %1072
  %1074 = fcmp contract ogt <16 x float> %1073, zeroinitializer
  %1075 = select contract <16 x i1> %1074, <16 x float> %1073, <16 x float> zeroinitializer
  %1076 = load float, ptr %1067, align 4
  %1077 = getelementptr inbounds i8, ptr %1067, i64 4
  %1078 = load float, ptr %1077, align 4
  %1079 = getelementptr inbounds i8, ptr %1067, i64 8
  %1080 = load float, ptr %1079, align 4
  %1081 = insertelement <16 x float> poison, float %1076, i64 0
  %1082 = shufflevector <16 x float> %1081, <16 x float> poison, <16 x i32> zeroinitializer
  %1083 = fmul contract <16 x float> %782, %1082
  %1084 = fadd contract <16 x float> %781, %1083
  %1085 = insertelement <16 x float> poison, float %1078, i64 0
  %1086 = shufflevector <16 x float> %1085, <16 x float> poison, <16 x i32> zeroinitializer
  %1087 = fmul contract <16 x float> %788, %1086
  %1088 = fadd contract <16 x float> %1084, %1087
  %1089 = insertelement <16 x float> poison, float %1080, i64 0
  %1090 = shufflevector <16 x float> %1089, <16 x float> poison, <16 x i32> zeroinitializer
  %1091 = fmul contract <16 x float> %794, %1090
  %1092 = fadd contract <16 x float> %1088, %1091
  %1093 = fmul contract <16 x float> %802, %1082
  %1094 = fadd contract <16 x float> %800, %1093
  %1095 = fmul contract <16 x float> %806, %1086
  %1096 = fadd contract <16 x float> %1094, %1095
  %1097 = fmul contract <16 x float> %810, %1090
  %1098 = fadd contract <16 x float> %1096, %1097
  %1099 = fmul contract <16 x float> %816, %1082
  %1100 = fadd contract <16 x float> %814, %1099
  %1101 = fmul contract <16 x float> %820, %1086
  %1102 = fadd contract <16 x float> %1100, %1101
  %1103 = fmul contract <16 x float> %824, %1090
  %1104 = fadd contract <16 x float> %1102, %1103
  %1105 = fmul contract <16 x float> %865, %1092
  %1106 = fadd contract <16 x float> %862, %1105
  %1107 = fmul contract <16 x float> %871, %1098
  %1108 = fadd contract <16 x float> %1107, %1106
  %1109 = fmul contract <16 x float> %877, %1104
  %1110 = fadd contract <16 x float> %1109, %1108
  %1111 = fmul contract <16 x float> %887, %1092
  %1112 = fadd contract <16 x float> %883, %1111
  %1113 = fmul contract <16 x float> %893, %1098
  %1114 = fadd contract <16 x float> %1113, %1112
  %1115 = fmul contract <16 x float> %899, %1104
  %1116 = fadd contract <16 x float> %1115, %1114
  %1117 = fmul contract <16 x float> %909, %1092
  %1118 = fadd contract <16 x float> %905, %1117
  %1119 = fmul contract <16 x float> %915, %1098
  %1120 = fadd contract <16 x float> %1119, %1118
  %1121 = fmul contract <16 x float> %921, %1104
  %1122 = fadd contract <16 x float> %1121, %1120
  %1123 = fmul contract <16 x float> %1110, zeroinitializer
  %1124 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %1122)
  %1125 = select contract i1 %927, <16 x float> %1122, <16 x float> %1124
  br i1 %932, label %1126, label %1131

1126:
  %1127 = fmul contract <16 x float> %1110, %1110
  %1128 = fmul contract <16 x float> %1116, %1116
  %1129 = fadd contract <16 x float> %1127, %1128
  %1130 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %1129)
  br label %1133

1131:
  %1132 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %1110)
  br label %1133

1133:
  %1134 = phi contract <16 x float> [ %1130, %1126 ], [ %1132, %1131 ]
  %1135 = fsub contract <16 x float> %1134, %945
  %1136 = fcmp contract ogt <16 x float> %1135, %1123
  %1137 = select contract <16 x i1> %1136, <16 x float> %1135, <16 x float> %1123
  %1138 = fsub contract <16 x float> %1125, %952
  %1139 = fcmp contract ogt <16 x float> %1138, %1123
  %1140 = select contract <16 x i1> %1139, <16 x float> %1138, <16 x float> %1123
  %1141 = fmul contract <16 x float> %1137, %1137
  %1142 = fmul contract <16 x float> %1140, %1140
  %1143 = fadd contract <16 x float> %1142, %1141
  br i1 %932, label %1154, label %1144

1144:
  %1145 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %1116)
  %1146 = load float, ptr %985, align 4
  %1147 = insertelement <16 x float> poison, float %1146, i64 0
  %1148 = shufflevector <16 x float> %1147, <16 x float> poison, <16 x i32> zeroinitializer
  %1149 = fsub contract <16 x float> %1145, %1148
  %1150 = fcmp contract ogt <16 x float> %1149, %1123
  %1151 = select contract <16 x i1> %1150, <16 x float> %1149, <16 x float> %1123
  %1152 = fmul contract <16 x float> %1151, %1151
  %1153 = fadd contract <16 x float> %1143, %1152
  br label %1154

1154:
  %1155 = phi <16 x float> [ %1153, %1144 ], [ %1143, %1133 ]
  %1156 = fmul contract <16 x float> %1075, %1075
  %1157 = fcmp contract olt <16 x float> %1155, %1156
  %1158 = select <16 x i1> %1157, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %1065
  %1159 = add nsw i64 %1066, 1
  %1160 = icmp eq i64 %1159, %981
  br i1 %1160, label %986, label %1064

1161:
  %1162 = load i64, ptr %46, align 8
  br label %1163

1163:
  %1164 = phi i64 [ %836, %835 ], [ %836, %970 ], [ %836, %986 ], [ %836, %996 ], [ %1162, %1161 ]
  %1165 = phi i64 [ %839, %835 ], [ %839, %970 ], [ %839, %986 ], [ %839, %996 ], [ %1060, %1161 ]
  %1166 = phi <16 x i32> [ %837, %835 ], [ %837, %970 ], [ %988, %986 ], [ %988, %996 ], [ %988, %1161 ]
  %1167 = add nuw nsw i64 %838, 1
  %1168 = icmp slt i64 %1167, %1164
  br i1 %1168, label %835, label %1169

1169:
  %1170 = load i64, ptr %0, align 8
  br label %1171

1171:
  %1172 = phi i64 [ %764, %763 ], [ %764, %773 ], [ %1170, %1169 ]
  %1173 = phi i64 [ %767, %763 ], [ %767, %773 ], [ %1165, %1169 ]
  %1174 = phi <16 x i32> [ %765, %763 ], [ %765, %773 ], [ %1166, %1169 ]
  %1175 = add nuw nsw i64 %766, 1
  %1176 = icmp slt i64 %766, %1172
  br i1 %1176, label %763, label %756

1177:
  %1178 = phi <16 x i32> [ %1762, %1759 ], [ %761, %758 ]
  %1179 = phi i64 [ %1761, %1759 ], [ 0, %758 ]
  %1180 = phi i64 [ %1763, %1759 ], [ 0, %758 ]
  %1181 = phi i64 [ %1760, %1759 ], [ %760, %758 ]
  %1182 = load ptr, ptr %44, align 8
  %1183 = getelementptr inbounds %struct.LinkPair, ptr %1182, i64 %1180
  %1184 = load ptr, ptr %42, align 8
  %1185 = load i64, ptr %1183, align 8
  %1186 = getelementptr inbounds %struct.Sphere, ptr %1184, i64 %1185
  %1187 = getelementptr inbounds i8, ptr %1183, i64 8
  %1188 = load i64, ptr %1187, align 8
  %1189 = getelementptr inbounds %struct.Sphere, ptr %1184, i64 %1188
  %1190 = getelementptr inbounds %struct.Frame, ptr %27, i64 %1185
  %1191 = getelementptr inbounds %struct.Frame, ptr %27, i64 %1188
  %1192 = getelementptr inbounds <16 x float>, ptr %20, i64 %1180
  %1193 = load <16 x float>, ptr %1192, align 64
  %1194 = load ptr, ptr %51, align 8
  %1195 = getelementptr inbounds float, ptr %1194, i64 %1180
  %1196 = load float, ptr %1195, align 4
  %1197 = insertelement <16 x float> poison, float %1196, i64 0
  %1198 = shufflevector <16 x float> %1197, <16 x float> poison, <16 x i32> zeroinitializer
  %1199 = fadd contract <16 x float> %1193, %1198
  %1200 = load float, ptr %1189, align 4
  %1201 = getelementptr inbounds i8, ptr %1189, i64 4
  %1202 = load float, ptr %1201, align 4
  %1203 = getelementptr inbounds i8, ptr %1189, i64 8
  %1204 = load float, ptr %1203, align 4
  %1205 = getelementptr inbounds i8, ptr %1191, i64 576
  %1206 = load <16 x float>, ptr %1205, align 64
  %1207 = load <16 x float>, ptr %1191, align 64
  %1208 = insertelement <16 x float> poison, float %1200, i64 0
  %1209 = shufflevector <16 x float> %1208, <16 x float> poison, <16 x i32> zeroinitializer
  %1210 = fmul contract <16 x float> %1209, %1207
  %1211 = fadd contract <16 x float> %1206, %1210
  %1212 = getelementptr inbounds i8, ptr %1191, i64 64
  %1213 = load <16 x float>, ptr %1212, align 64
  %1214 = insertelement <16 x float> poison, float %1202, i64 0
  %1215 = shufflevector <16 x float> %1214, <16 x float> poison, <16 x i32> zeroinitializer
  %1216 = fmul contract <16 x float> %1215, %1213
  %1217 = fadd contract <16 x float> %1211, %1216
  %1218 = getelementptr inbounds i8, ptr %1191, i64 128
  %1219 = load <16 x float>, ptr %1218, align 64
  %1220 = insertelement <16 x float> poison, float %1204, i64 0
  %1221 = shufflevector <16 x float> %1220, <16 x float> poison, <16 x i32> zeroinitializer
  %1222 = fmul contract <16 x float> %1221, %1219
  %1223 = fadd contract <16 x float> %1217, %1222
  %1224 = getelementptr inbounds i8, ptr %1191, i64 640
  %1225 = load <16 x float>, ptr %1224, align 64
  %1226 = getelementptr inbounds i8, ptr %1191, i64 192
  %1227 = load <16 x float>, ptr %1226, align 64
  %1228 = fmul contract <16 x float> %1209, %1227
  %1229 = fadd contract <16 x float> %1225, %1228
  %1230 = getelementptr inbounds i8, ptr %1191, i64 256
  %1231 = load <16 x float>, ptr %1230, align 64
  %1232 = fmul contract <16 x float> %1215, %1231
  %1233 = fadd contract <16 x float> %1229, %1232
  %1234 = getelementptr inbounds i8, ptr %1191, i64 320
  %1235 = load <16 x float>, ptr %1234, align 64
  %1236 = fmul contract <16 x float> %1221, %1235
  %1237 = fadd contract <16 x float> %1233, %1236
  %1238 = getelementptr inbounds i8, ptr %1191, i64 704
  %1239 = load <16 x float>, ptr %1238, align 64
  %1240 = getelementptr inbounds i8, ptr %1191, i64 384
  %1241 = load <16 x float>, ptr %1240, align 64
  %1242 = fmul contract <16 x float> %1209, %1241
  %1243 = fadd contract <16 x float> %1239, %1242
  %1244 = getelementptr inbounds i8, ptr %1191, i64 448
  %1245 = load <16 x float>, ptr %1244, align 64
  %1246 = fmul contract <16 x float> %1215, %1245
  %1247 = fadd contract <16 x float> %1243, %1246
  %1248 = getelementptr inbounds i8, ptr %1191, i64 512
  %1249 = load <16 x float>, ptr %1248, align 64
  %1250 = fmul contract <16 x float> %1221, %1249
  %1251 = fadd contract <16 x float> %1247, %1250
  %1252 = getelementptr inbounds i8, ptr %1186, i64 12
  %1253 = load float, ptr %1252, align 4
  %1254 = getelementptr inbounds i8, ptr %1189, i64 12
  %1255 = load float, ptr %1254, align 4
  %1256 = fadd contract float %1253, %1255
  %1257 = insertelement <16 x float> poison, float %1256, i64 0
  %1258 = shufflevector <16 x float> %1257, <16 x float> poison, <16 x i32> zeroinitializer
  %1259 = fadd contract <16 x float> %1199, %1258
  %1260 = fcmp contract ogt <16 x float> %1259, zeroinitializer
  %1261 = select contract <16 x i1> %1260, <16 x float> %1259, <16 x float> zeroinitializer
  %1262 = load float, ptr %1186, align 4
  %1263 = getelementptr inbounds i8, ptr %1186, i64 4
  %1264 = load float, ptr %1263, align 4
  %1265 = getelementptr inbounds i8, ptr %1186, i64 8
  %1266 = load float, ptr %1265, align 4
  %1267 = getelementptr inbounds i8, ptr %1190, i64 576
  %1268 = load <16 x float>, ptr %1267, align 64
  %1269 = load <16 x float>, ptr %1190, align 64
  %1270 = insertelement <16 x float> poison, float %1262, i64 0
  %1271 = shufflevector <16 x float> %1270, <16 x float> poison, <16 x i32> zeroinitializer
  %1272 = fmul contract <16 x float> %1271, %1269
  %1273 = fadd contract <16 x float> %1268, %1272
  %1274 = getelementptr inbounds i8, ptr %1190, i64 64
  %1275 = load <16 x float>, ptr %1274, align 64
  %1276 = insertelement <16 x float> poison, float %1264, i64 0
  %1277 = shufflevector <16 x float> %1276, <16 x float> poison, <16 x i32> zeroinitializer
  %1278 = fmul contract <16 x float> %1277, %1275
  %1279 = fadd contract <16 x float> %1273, %1278
  %1280 = getelementptr inbounds i8, ptr %1190, i64 128
  %1281 = load <16 x float>, ptr %1280, align 64
  %1282 = insertelement <16 x float> poison, float %1266, i64 0
  %1283 = shufflevector <16 x float> %1282, <16 x float> poison, <16 x i32> zeroinitializer
  %1284 = fmul contract <16 x float> %1283, %1281
  %1285 = fadd contract <16 x float> %1279, %1284
  %1286 = getelementptr inbounds i8, ptr %1190, i64 640
  %1287 = load <16 x float>, ptr %1286, align 64
  %1288 = getelementptr inbounds i8, ptr %1190, i64 192
  %1289 = load <16 x float>, ptr %1288, align 64
  %1290 = fmul contract <16 x float> %1271, %1289
  %1291 = fadd contract <16 x float> %1287, %1290
  %1292 = getelementptr inbounds i8, ptr %1190, i64 256
  %1293 = load <16 x float>, ptr %1292, align 64
  %1294 = fmul contract <16 x float> %1277, %1293
  %1295 = fadd contract <16 x float> %1291, %1294
  %1296 = getelementptr inbounds i8, ptr %1190, i64 320
  %1297 = load <16 x float>, ptr %1296, align 64
  %1298 = fmul contract <16 x float> %1283, %1297
  %1299 = fadd contract <16 x float> %1295, %1298
  %1300 = getelementptr inbounds i8, ptr %1190, i64 704
  %1301 = load <16 x float>, ptr %1300, align 64
  %1302 = getelementptr inbounds i8, ptr %1190, i64 384
  %1303 = load <16 x float>, ptr %1302, align 64
  %1304 = fmul contract <16 x float> %1271, %1303
  %1305 = fadd contract <16 x float> %1301, %1304
  %1306 = getelementptr inbounds i8, ptr %1190, i64 448
  %1307 = load <16 x float>, ptr %1306, align 64
  %1308 = fmul contract <16 x float> %1277, %1307
  %1309 = fadd contract <16 x float> %1305, %1308
  %1310 = getelementptr inbounds i8, ptr %1190, i64 512
  %1311 = load <16 x float>, ptr %1310, align 64
  %1312 = fmul contract <16 x float> %1283, %1311
  %1313 = fadd contract <16 x float> %1309, %1312
  %1314 = fsub contract <16 x float> %1285, %1223
  %1315 = fsub contract <16 x float> %1299, %1237
  %1316 = fsub contract <16 x float> %1313, %1251
  %1317 = fmul contract <16 x float> %1314, %1314
  %1318 = fmul contract <16 x float> %1315, %1315
  %1319 = fadd contract <16 x float> %1317, %1318
  %1320 = fmul contract <16 x float> %1316, %1316
  %1321 = fadd contract <16 x float> %1319, %1320
  %1322 = fmul contract <16 x float> %1261, %1261
  %1323 = fcmp contract olt <16 x float> %1321, %1322
  %1324 = bitcast <16 x i1> %1323 to i16
  %1325 = icmp eq i16 %1324, 0
  br i1 %1325, label %1759, label %1326

1326:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %14)
  store i64 %1185, ptr %14, align 16
  store i64 %1188, ptr %52, align 8
  br label %1333

1327:
  %1328 = getelementptr inbounds i8, ptr %1183, i64 16
  %1329 = load i64, ptr %1328, align 8
  %1330 = getelementptr inbounds i8, ptr %1183, i64 24
  %1331 = load i64, ptr %1330, align 8
  %1332 = icmp slt i64 %1329, %1331
  br i1 %1332, label %1419, label %1416

1333:
  %1334 = phi i64 [ %1179, %1326 ], [ %1413, %1412 ]
  %1335 = phi i64 [ 0, %1326 ], [ %1414, %1412 ]
  %1336 = getelementptr inbounds i8, ptr %14, i64 %1335
  %1337 = load i64, ptr %1336, align 8
  %1338 = shl nuw i64 1, %1337
  %1339 = and i64 %1338, %1334
  %1340 = icmp eq i64 %1339, 0
  br i1 %1340, label %1341, label %1412

1341:
  %1342 = or i64 %1338, %1334
  %1343 = load ptr, ptr %53, align 8
  %1344 = getelementptr inbounds i64, ptr %1343, i64 %1337
  %1345 = load i64, ptr %1344, align 8
  %1346 = getelementptr i8, ptr %1344, i64 8
  %1347 = load i64, ptr %1346, align 8
  %1348 = icmp slt i64 %1345, %1347
  br i1 %1348, label %1349, label %1412

1349:
  %1350 = load ptr, ptr %54, align 8
  %1351 = getelementptr inbounds %struct.Frame, ptr %27, i64 %1337
  %1352 = getelementptr inbounds i8, ptr %1351, i64 576
  %1353 = load <16 x float>, ptr %1352, align 64
  %1354 = load <16 x float>, ptr %1351, align 64
  %1355 = getelementptr inbounds i8, ptr %1351, i64 64
  %1356 = load <16 x float>, ptr %1355, align 64
  %1357 = getelementptr inbounds i8, ptr %1351, i64 128
  %1358 = load <16 x float>, ptr %1357, align 64
  %1359 = getelementptr inbounds i8, ptr %1351, i64 640
  %1360 = load <16 x float>, ptr %1359, align 64
  %1361 = getelementptr inbounds i8, ptr %1351, i64 192
  %1362 = load <16 x float>, ptr %1361, align 64
  %1363 = getelementptr inbounds i8, ptr %1351, i64 256
  %1364 = load <16 x float>, ptr %1363, align 64
  %1365 = getelementptr inbounds i8, ptr %1351, i64 320
  %1366 = load <16 x float>, ptr %1365, align 64
  %1367 = getelementptr inbounds i8, ptr %1351, i64 704
  %1368 = load <16 x float>, ptr %1367, align 64
  %1369 = getelementptr inbounds i8, ptr %1351, i64 384
  %1370 = load <16 x float>, ptr %1369, align 64
  %1371 = getelementptr inbounds i8, ptr %1351, i64 448
  %1372 = load <16 x float>, ptr %1371, align 64
  %1373 = getelementptr inbounds i8, ptr %1351, i64 512
  %1374 = load <16 x float>, ptr %1373, align 64
  br label %1375

1375:
  %1376 = phi i64 [ %1345, %1349 ], [ %1410, %1375 ]
  %1377 = getelementptr inbounds %struct.Part, ptr %1350, i64 %1376
  %1378 = load float, ptr %1377, align 4
  %1379 = getelementptr inbounds i8, ptr %1377, i64 4
  %1380 = load float, ptr %1379, align 4
  %1381 = getelementptr inbounds i8, ptr %1377, i64 8
  %1382 = load float, ptr %1381, align 4
  %1383 = insertelement <16 x float> poison, float %1378, i64 0
  %1384 = shufflevector <16 x float> %1383, <16 x float> poison, <16 x i32> zeroinitializer
  %1385 = fmul contract <16 x float> %1384, %1354
  %1386 = fadd contract <16 x float> %1353, %1385
  %1387 = insertelement <16 x float> poison, float %1380, i64 0
  %1388 = shufflevector <16 x float> %1387, <16 x float> poison, <16 x i32> zeroinitializer
  %1389 = fmul contract <16 x float> %1388, %1356
  %1390 = fadd contract <16 x float> %1386, %1389
  %1391 = insertelement <16 x float> poison, float %1382, i64 0
  %1392 = shufflevector <16 x float> %1391, <16 x float> poison, <16 x i32> zeroinitializer
  %1393 = fmul contract <16 x float> %1392, %1358
  %1394 = fadd contract <16 x float> %1390, %1393
  %1395 = fmul contract <16 x float> %1384, %1362
  %1396 = fadd contract <16 x float> %1360, %1395
  %1397 = fmul contract <16 x float> %1388, %1364
  %1398 = fadd contract <16 x float> %1396, %1397
  %1399 = fmul contract <16 x float> %1392, %1366
  %1400 = fadd contract <16 x float> %1398, %1399
  %1401 = fmul contract <16 x float> %1384, %1370
  %1402 = fadd contract <16 x float> %1368, %1401
  %1403 = fmul contract <16 x float> %1388, %1372
  %1404 = fadd contract <16 x float> %1402, %1403
  %1405 = fmul contract <16 x float> %1392, %1374
  %1406 = fadd contract <16 x float> %1404, %1405
  %1407 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1376
  store <16 x float> %1394, ptr %1407, align 64
  %1408 = getelementptr inbounds i8, ptr %1407, i64 64
  store <16 x float> %1400, ptr %1408, align 64
  %1409 = getelementptr inbounds i8, ptr %1407, i64 128
  store <16 x float> %1406, ptr %1409, align 64
  %1410 = add nsw i64 %1376, 1
  %1411 = icmp eq i64 %1410, %1347
  br i1 %1411, label %1412, label %1375

1412:
  %1413 = phi i64 [ %1334, %1333 ], [ %1342, %1341 ], [ %1342, %1375 ]
  %1414 = add nuw nsw i64 %1335, 8
  %1415 = icmp eq i64 %1414, 16
  br i1 %1415, label %1327, label %1333

1416:
  %1417 = phi i64 [ %1181, %1327 ], [ %1754, %1751 ]
  %1418 = phi <16 x i32> [ %1178, %1327 ], [ %1755, %1751 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %14)
  br label %1759

1419:
  %1420 = phi <16 x i32> [ %1755, %1751 ], [ %1178, %1327 ]
  %1421 = phi i64 [ %1756, %1751 ], [ %1329, %1327 ]
  %1422 = phi i1 [ %1752, %1751 ], [ false, %1327 ]
  %1423 = phi i64 [ %1753, %1751 ], [ -1, %1327 ]
  %1424 = phi i64 [ %1754, %1751 ], [ %1181, %1327 ]
  %1425 = load ptr, ptr %55, align 8
  %1426 = getelementptr inbounds %struct.PartPair, ptr %1425, i64 %1421
  %1427 = load ptr, ptr %54, align 8
  %1428 = load i64, ptr %1426, align 8
  %1429 = getelementptr inbounds %struct.Part, ptr %1427, i64 %1428
  %1430 = getelementptr inbounds i8, ptr %1426, i64 8
  %1431 = load i64, ptr %1430, align 8
  %1432 = getelementptr inbounds %struct.Part, ptr %1427, i64 %1431
  %1433 = icmp eq i64 %1428, %1423
  br i1 %1433, label %1462, label %1434

1434:
  %1435 = getelementptr inbounds i8, ptr %1429, i64 28
  %1436 = load float, ptr %1435, align 4
  %1437 = load float, ptr %1254, align 4
  %1438 = fadd contract float %1436, %1437
  %1439 = insertelement <16 x float> poison, float %1438, i64 0
  %1440 = shufflevector <16 x float> %1439, <16 x float> poison, <16 x i32> zeroinitializer
  %1441 = fadd contract <16 x float> %1199, %1440
  %1442 = fcmp contract ogt <16 x float> %1441, zeroinitializer
  %1443 = select contract <16 x i1> %1442, <16 x float> %1441, <16 x float> zeroinitializer
  %1444 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1428
  %1445 = load <16 x float>, ptr %1444, align 64
  %1446 = fsub contract <16 x float> %1445, %1223
  %1447 = getelementptr inbounds i8, ptr %1444, i64 64
  %1448 = load <16 x float>, ptr %1447, align 64
  %1449 = fsub contract <16 x float> %1448, %1237
  %1450 = getelementptr inbounds i8, ptr %1444, i64 128
  %1451 = load <16 x float>, ptr %1450, align 64
  %1452 = fsub contract <16 x float> %1451, %1251
  %1453 = fmul contract <16 x float> %1446, %1446
  %1454 = fmul contract <16 x float> %1449, %1449
  %1455 = fadd contract <16 x float> %1453, %1454
  %1456 = fmul contract <16 x float> %1452, %1452
  %1457 = fadd contract <16 x float> %1455, %1456
  %1458 = fmul contract <16 x float> %1443, %1443
  %1459 = fcmp contract olt <16 x float> %1457, %1458
  %1460 = bitcast <16 x i1> %1459 to i16
  %1461 = icmp eq i16 %1460, 0
  br i1 %1461, label %1751, label %1463

1462:
  br i1 %1422, label %1463, label %1751

1463:
  %1464 = phi i64 [ %1428, %1434 ], [ %1423, %1462 ]
  %1465 = getelementptr inbounds i8, ptr %1429, i64 28
  %1466 = load float, ptr %1465, align 4
  %1467 = getelementptr inbounds i8, ptr %1432, i64 28
  %1468 = load float, ptr %1467, align 4
  %1469 = fadd contract float %1466, %1468
  %1470 = insertelement <16 x float> poison, float %1469, i64 0
  %1471 = shufflevector <16 x float> %1470, <16 x float> poison, <16 x i32> zeroinitializer
  %1472 = fadd contract <16 x float> %1199, %1471
  %1473 = fcmp contract ogt <16 x float> %1472, zeroinitializer
  %1474 = select contract <16 x i1> %1473, <16 x float> %1472, <16 x float> zeroinitializer
  %1475 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1428
  %1476 = getelementptr inbounds [192 x %struct.Point], ptr %13, i64 0, i64 %1431
  %1477 = load <16 x float>, ptr %1475, align 64
  %1478 = load <16 x float>, ptr %1476, align 64
  %1479 = fsub contract <16 x float> %1477, %1478
  %1480 = getelementptr inbounds i8, ptr %1475, i64 64
  %1481 = load <16 x float>, ptr %1480, align 64
  %1482 = getelementptr inbounds i8, ptr %1476, i64 64
  %1483 = load <16 x float>, ptr %1482, align 64
  %1484 = fsub contract <16 x float> %1481, %1483
  %1485 = getelementptr inbounds i8, ptr %1475, i64 128
  %1486 = load <16 x float>, ptr %1485, align 64
  %1487 = getelementptr inbounds i8, ptr %1476, i64 128
  %1488 = load <16 x float>, ptr %1487, align 64
  %1489 = fsub contract <16 x float> %1486, %1488
  %1490 = fmul contract <16 x float> %1479, %1479
  %1491 = fmul contract <16 x float> %1484, %1484
  %1492 = fadd contract <16 x float> %1490, %1491
  %1493 = fmul contract <16 x float> %1489, %1489
  %1494 = fadd contract <16 x float> %1492, %1493
  %1495 = fmul contract <16 x float> %1474, %1474
  %1496 = fcmp contract olt <16 x float> %1494, %1495
  %1497 = bitcast <16 x i1> %1496 to i16
  %1498 = icmp eq i16 %1497, 0
  br i1 %1498, label %1751, label %1499

1499:
  %1500 = getelementptr inbounds i8, ptr %1429, i64 24
  %1501 = load float, ptr %1500, align 4
  %1502 = getelementptr inbounds i8, ptr %1432, i64 24
  %1503 = load float, ptr %1502, align 4
  %1504 = fadd contract float %1501, %1503
  %1505 = insertelement <16 x float> poison, float %1504, i64 0
  %1506 = shufflevector <16 x float> %1505, <16 x float> poison, <16 x i32> zeroinitializer
  %1507 = fadd contract <16 x float> %1199, %1506
  %1508 = fcmp contract ogt <16 x float> %1507, zeroinitializer
  %1509 = select contract <16 x i1> %1508, <16 x float> %1507, <16 x float> zeroinitializer
  %1510 = getelementptr inbounds i8, ptr %1429, i64 12
  %1511 = load float, ptr %1510, align 4
  %1512 = fmul contract float %1511, %1511
  %1513 = getelementptr inbounds i8, ptr %1429, i64 16
  %1514 = load float, ptr %1513, align 4
  %1515 = fmul contract float %1514, %1514
  %1516 = fadd contract float %1512, %1515
  %1517 = getelementptr inbounds i8, ptr %1429, i64 20
  %1518 = load float, ptr %1517, align 4
  %1519 = fmul contract float %1518, %1518
  %1520 = fadd contract float %1516, %1519
  %1521 = getelementptr inbounds i8, ptr %1432, i64 12
  %1522 = load float, ptr %1521, align 4
  %1523 = fmul contract float %1522, %1522
  %1524 = getelementptr inbounds i8, ptr %1432, i64 16
  %1525 = load float, ptr %1524, align 4
  %1526 = fmul contract float %1525, %1525
  %1527 = fadd contract float %1523, %1526
  %1528 = getelementptr inbounds i8, ptr %1432, i64 20
  %1529 = load float, ptr %1528, align 4
  %1530 = fmul contract float %1529, %1529
  %1531 = fadd contract float %1527, %1530
  %1532 = fcmp contract oeq float %1520, 0.000000e+00
  %1533 = fcmp contract oeq float %1531, 0.000000e+00
  %1534 = select i1 %1532, i1 %1533, i1 false
  br i1 %1534, label %1666, label %1535

1535:
  %1536 = fmul contract <16 x float> %1477, zeroinitializer
  %1537 = fadd contract <16 x float> %1536, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %1538 = insertelement <16 x float> poison, float %1511, i64 0
  %1539 = shufflevector <16 x float> %1538, <16 x float> poison, <16 x i32> zeroinitializer
  %1540 = fmul contract <16 x float> %1269, %1539
  %1541 = insertelement <16 x float> poison, float %1514, i64 0
  %1542 = shufflevector <16 x float> %1541, <16 x float> poison, <16 x i32> zeroinitializer
  %1543 = fmul contract <16 x float> %1275, %1542
  %1544 = fadd contract <16 x float> %1540, %1543
  %1545 = insertelement <16 x float> poison, float %1518, i64 0
  %1546 = shufflevector <16 x float> %1545, <16 x float> poison, <16 x i32> zeroinitializer
  %1547 = fmul contract <16 x float> %1281, %1546
  %1548 = fadd contract <16 x float> %1544, %1547
  %1549 = fmul contract <16 x float> %1289, %1539
  %1550 = fmul contract <16 x float> %1293, %1542
  %1551 = fadd contract <16 x float> %1549, %1550
  %1552 = fmul contract <16 x float> %1297, %1546
  %1553 = fadd contract <16 x float> %1551, %1552
  %1554 = fmul contract <16 x float> %1303, %1539
  %1555 = fmul contract <16 x float> %1307, %1542
  %1556 = fadd contract <16 x float> %1554, %1555
  %1557 = fmul contract <16 x float> %1311, %1546
  %1558 = fadd contract <16 x float> %1556, %1557
  %1559 = insertelement <16 x float> poison, float %1522, i64 0
  %1560 = shufflevector <16 x float> %1559, <16 x float> poison, <16 x i32> zeroinitializer
  %1561 = fmul contract <16 x float> %1207, %1560
  %1562 = insertelement <16 x float> poison, float %1525, i64 0
  %1563 = shufflevector <16 x float> %1562, <16 x float> poison, <16 x i32> zeroinitializer
  %1564 = fmul contract <16 x float> %1213, %1563
  %1565 = fadd contract <16 x float> %1561, %1564
  %1566 = insertelement <16 x float> poison, float %1529, i64 0
  %1567 = shufflevector <16 x float> %1566, <16 x float> poison, <16 x i32> zeroinitializer
  %1568 = fmul contract <16 x float> %1219, %1567
  %1569 = fadd contract <16 x float> %1565, %1568
  %1570 = fmul contract <16 x float> %1227, %1560
  %1571 = fmul contract <16 x float> %1231, %1563
  %1572 = fadd contract <16 x float> %1570, %1571
  %1573 = fmul contract <16 x float> %1235, %1567
  %1574 = fadd contract <16 x float> %1572, %1573
  %1575 = fmul contract <16 x float> %1241, %1560
  %1576 = fmul contract <16 x float> %1245, %1563
  %1577 = fadd contract <16 x float> %1575, %1576
  %1578 = fmul contract <16 x float> %1249, %1567
  %1579 = fadd contract <16 x float> %1577, %1578
  %1580 = fcmp contract ogt float %1520, 0.000000e+00
  %1581 = fdiv contract float 1.000000e+00, %1520
  %1582 = select contract i1 %1580, float %1581, float 0.000000e+00
  %1583 = fcmp contract ogt float %1531, 0.000000e+00
  %1584 = fdiv contract float 1.000000e+00, %1531
  %1585 = select contract i1 %1583, float %1584, float 0.000000e+00
  %1586 = fmul contract <16 x float> %1548, %1569
  %1587 = fmul contract <16 x float> %1553, %1574
  %1588 = fadd contract <16 x float> %1586, %1587
  %1589 = fmul contract <16 x float> %1558, %1579
  %1590 = fadd contract <16 x float> %1589, %1588
  %1591 = fmul contract <16 x float> %1479, %1548
  %1592 = fmul contract <16 x float> %1484, %1553
  %1593 = fadd contract <16 x float> %1591, %1592
  %1594 = fmul contract <16 x float> %1489, %1558
  %1595 = fadd contract <16 x float> %1594, %1593
  %1596 = fmul contract <16 x float> %1479, %1569
  %1597 = fmul contract <16 x float> %1484, %1574
  %1598 = fadd contract <16 x float> %1596, %1597
  %1599 = fmul contract <16 x float> %1489, %1579
  %1600 = fadd contract <16 x float> %1599, %1598
  %1601 = fmul contract float %1520, %1531
  %1602 = insertelement <16 x float> poison, float %1601, i64 0
  %1603 = shufflevector <16 x float> %1602, <16 x float> poison, <16 x i32> zeroinitializer
  %1604 = fmul contract <16 x float> %1590, %1590
  %1605 = fsub contract <16 x float> %1603, %1604
  %1606 = fmul contract float %1520, 0x3E7AD7F2A0000000
  %1607 = fmul contract float %1606, %1531
  %1608 = insertelement <16 x float> poison, float %1607, i64 0
  %1609 = shufflevector <16 x float> %1608, <16 x float> poison, <16 x i32> zeroinitializer
  %1610 = fcmp contract ogt <16 x float> %1605, %1609
  %1611 = fmul contract <16 x float> %1590, %1600
  %1612 = insertelement <16 x float> poison, float %1531, i64 0
  %1613 = shufflevector <16 x float> %1612, <16 x float> poison, <16 x i32> zeroinitializer
  %1614 = fmul contract <16 x float> %1613, %1595
  %1615 = fsub contract <16 x float> %1611, %1614
  %1616 = select contract <16 x i1> %1610, <16 x float> %1605, <16 x float> %1537
  %1617 = fdiv contract <16 x float> %1615, %1616
  %1618 = fneg contract <16 x float> %1537
  %1619 = fcmp contract ogt <16 x float> %1617, %1618
  %1620 = select contract <16 x i1> %1619, <16 x float> %1617, <16 x float> %1618
  %1621 = fcmp contract olt <16 x float> %1620, %1537
  %1622 = select contract <16 x i1> %1621, <16 x float> %1620, <16 x float> %1537
  %1623 = select contract <16 x i1> %1610, <16 x float> %1622, <16 x float> %1618
  %1624 = fmul contract <16 x float> %1590, %1623
  %1625 = fadd contract <16 x float> %1600, %1624
  %1626 = insertelement <16 x float> poison, float %1585, i64 0
  %1627 = shufflevector <16 x float> %1626, <16 x float> poison, <16 x i32> zeroinitializer
  %1628 = fmul contract <16 x float> %1627, %1625
  %1629 = fcmp contract ogt <16 x float> %1628, %1618
  %1630 = select contract <16 x i1> %1629, <16 x float> %1628, <16 x float> %1618
  %1631 = fcmp contract olt <16 x float> %1630, %1537
  %1632 = select contract <16 x i1> %1631, <16 x float> %1630, <16 x float> %1537
  %1633 = fmul contract <16 x float> %1590, %1632
  %1634 = fsub contract <16 x float> %1633, %1595
  %1635 = insertelement <16 x float> poison, float %1582, i64 0
  %1636 = shufflevector <16 x float> %1635, <16 x float> poison, <16 x i32> zeroinitializer
  %1637 = fmul contract <16 x float> %1636, %1634
  %1638 = fcmp contract ogt <16 x float> %1637, %1618
  %1639 = select contract <16 x i1> %1638, <16 x float> %1637, <16 x float> %1618
  %1640 = fcmp contract olt <16 x float> %1639, %1537
  %1641 = select contract <16 x i1> %1640, <16 x float> %1639, <16 x float> %1537
  %1642 = fmul contract <16 x float> %1590, %1641
  %1643 = fadd contract <16 x float> %1600, %1642
  %1644 = fmul contract <16 x float> %1627, %1643
  %1645 = fcmp contract ogt <16 x float> %1644, %1618
  %1646 = select contract <16 x i1> %1645, <16 x float> %1644, <16 x float> %1618
  %1647 = fcmp contract olt <16 x float> %1646, %1537
  %1648 = select contract <16 x i1> %1647, <16 x float> %1646, <16 x float> %1537
  %1649 = fmul contract <16 x float> %1548, %1641
  %1650 = fadd contract <16 x float> %1479, %1649
  %1651 = fmul contract <16 x float> %1569, %1648
  %1652 = fsub contract <16 x float> %1650, %1651
  %1653 = fmul contract <16 x float> %1553, %1641
  %1654 = fadd contract <16 x float> %1484, %1653
  %1655 = fmul contract <16 x float> %1574, %1648
  %1656 = fsub contract <16 x float> %1654, %1655
  %1657 = fmul contract <16 x float> %1558, %1641
  %1658 = fadd contract <16 x float> %1489, %1657
  %1659 = fmul contract <16 x float> %1579, %1648
  %1660 = fsub contract <16 x float> %1658, %1659
  %1661 = fmul contract <16 x float> %1652, %1652
  %1662 = fmul contract <16 x float> %1656, %1656
  %1663 = fadd contract <16 x float> %1661, %1662
  %1664 = fmul contract <16 x float> %1660, %1660
  %1665 = fadd contract <16 x float> %1664, %1663
  br label %1666

1666:
  %1667 = phi <16 x float> [ %1665, %1535 ], [ %1494, %1499 ]
  %1668 = fmul contract <16 x float> %1509, %1509
  %1669 = fcmp contract olt <16 x float> %1667, %1668
  %1670 = select <16 x i1> %1669, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %1420
  %1671 = load i64, ptr %0, align 8
  %1672 = load i64, ptr %46, align 8
  %1673 = mul nsw i64 %1672, %1671
  %1674 = add nsw i64 %1673, %1421
  %1675 = bitcast <16 x i1> %1669 to i16
  %1676 = zext i16 %1675 to i64
  %1677 = and i64 %181, %1676
  %1678 = icmp eq i64 %1677, 0
  br i1 %1678, label %1751, label %1679

1679:
  %1680 = load i64, ptr %1187, align 8
  %1681 = load i64, ptr %1183, align 8
  %1682 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %29, i64 0, i64 %1680, i64 %1681
  %1683 = load <16 x float>, ptr %1682, align 64
  %1684 = getelementptr inbounds [17 x [17 x <16 x float>]], ptr %28, i64 0, i64 %1680, i64 %1681
  %1685 = load <16 x float>, ptr %1684, align 64
  %1686 = and i64 %1677, %111
  %1687 = icmp eq i64 %1686, 0
  br i1 %1687, label %1751, label %1688

1688:
  %1689 = phi i64 [ %1747, %1746 ], [ %1424, %1679 ]
  %1690 = phi i64 [ %1749, %1746 ], [ %1686, %1679 ]
  %1691 = tail call range(i64 0, 65) i64 @llvm.cttz.i64(i64 %1690, i1 true)
  %1692 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1691
  %1693 = getelementptr inbounds i8, ptr %1692, i64 8
  %1694 = load float, ptr %1693, align 8
  %1695 = getelementptr inbounds i8, ptr %1692, i64 12
  %1696 = load float, ptr %1695, align 4
  %1697 = fcmp contract une float %1694, %1696
  br i1 %1697, label %1698, label %1746

1698:
  %1699 = load i64, ptr %1692, align 16
  %1700 = extractelement <16 x float> %1683, i64 %1691
  %1701 = extractelement <16 x float> %1685, i64 %1691
  %1702 = extractelement <16 x float> %580, i64 %1691
  %1703 = fmul contract float %1701, %1702
  %1704 = fadd contract float %1700, %1703
  %1705 = fpext float %1704 to double
  %1706 = fmul contract double %1705, 1.001000e+00
  %1707 = icmp sle i64 %1689, %4
  %1708 = icmp sgt i64 %1689, 0
  %1709 = and i1 %1707, %1708
  br i1 %1709, label %1710, label %1734

1710:
  %1711 = tail call i64 @llvm.umax.i64(i64 %1689, i64 64)
  %1712 = add nsw i64 %1711, -63
  br label %1713

1713:
  %1714 = phi i64 [ %1715, %1732 ], [ %1689, %1710 ]
  %1715 = add nsw i64 %1714, -1
  %1716 = getelementptr inbounds %struct.Contact, ptr %3, i64 %1715
  %1717 = getelementptr inbounds i8, ptr %1716, i64 16
  %1718 = load i64, ptr %1717, align 8
  %1719 = icmp eq i64 %1718, %1674
  br i1 %1719, label %1720, label %1732

1720:
  %1721 = load i64, ptr %1716, align 8
  %1722 = icmp eq i64 %1721, %1699
  br i1 %1722, label %1723, label %1732

1723:
  %1724 = getelementptr inbounds i8, ptr %1716, i64 12
  %1725 = load float, ptr %1724, align 4
  %1726 = fcmp contract une float %1725, %1694
  br i1 %1726, label %1732, label %1727

1727:
  %1728 = getelementptr inbounds i8, ptr %1716, i64 12
  store float %1696, ptr %1728, align 4
  %1729 = getelementptr inbounds i8, ptr %1716, i64 24
  %1730 = load double, ptr %1729, align 8
  %1731 = fcmp contract ogt double %1706, %1730
  br i1 %1731, label %1743, label %1746

1732:
  %1733 = icmp sgt i64 %1714, %1712
  br i1 %1733, label %1713, label %1734

1734:
  %1735 = add i64 %1689, 1
  %1736 = icmp slt i64 %1689, %4
  br i1 %1736, label %1737, label %1746

1737:
  %1738 = getelementptr inbounds %struct.Contact, ptr %3, i64 %1689
  store i64 %1699, ptr %1738, align 8
  %1739 = getelementptr inbounds i8, ptr %1738, i64 8
  store float %1694, ptr %1739, align 8
  %1740 = getelementptr inbounds i8, ptr %1738, i64 12
  store float %1696, ptr %1740, align 4
  %1741 = getelementptr inbounds i8, ptr %1738, i64 16
  store i64 %1674, ptr %1741, align 8
  %1742 = getelementptr inbounds i8, ptr %1738, i64 24
  br label %1743

1743:
  %1744 = phi i64 [ %1735, %1737 ], [ %1689, %1727 ]
  %1745 = phi ptr [ %1742, %1737 ], [ %1729, %1727 ]
  store double %1706, ptr %1745, align 8
  br label %1746

1746:
  %1747 = phi i64 [ %1744, %1743 ], [ %1735, %1734 ], [ %1689, %1727 ], [ %1689, %1688 ]
  %1748 = add nsw i64 %1690, -1
  %1749 = and i64 %1748, %1690
  %1750 = icmp eq i64 %1749, 0
  br i1 %1750, label %1751, label %1688

1751:
  %1752 = phi i1 [ true, %1463 ], [ false, %1462 ], [ true, %1666 ], [ true, %1679 ], [ false, %1434 ], [ true, %1746 ]
  %1753 = phi i64 [ %1464, %1463 ], [ %1423, %1462 ], [ %1464, %1666 ], [ %1464, %1679 ], [ %1428, %1434 ], [ %1464, %1746 ]
  %1754 = phi i64 [ %1424, %1463 ], [ %1424, %1462 ], [ %1424, %1666 ], [ %1424, %1679 ], [ %1424, %1434 ], [ %1747, %1746 ]
  %1755 = phi <16 x i32> [ %1420, %1463 ], [ %1420, %1462 ], [ %1670, %1666 ], [ %1670, %1679 ], [ %1420, %1434 ], [ %1670, %1746 ]
  %1756 = add nsw i64 %1421, 1
  %1757 = load i64, ptr %1330, align 8
  %1758 = icmp slt i64 %1756, %1757
  br i1 %1758, label %1419, label %1416

1759:
  %1760 = phi i64 [ %1417, %1416 ], [ %1181, %1177 ]
  %1761 = phi i64 [ %1413, %1416 ], [ %1179, %1177 ]
  %1762 = phi <16 x i32> [ %1418, %1416 ], [ %1178, %1177 ]
  %1763 = add nuw nsw i64 %1180, 1
  %1764 = load i64, ptr %43, align 8
  %1765 = icmp slt i64 %1763, %1764
  br i1 %1765, label %1177, label %1766

1766:
  %1767 = phi i64 [ %760, %758 ], [ %1760, %1759 ]
  %1768 = phi <16 x i32> [ %761, %758 ], [ %1762, %1759 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %13)
  %1769 = icmp ne <16 x i32> %1768, zeroinitializer
  %1770 = bitcast <16 x i1> %1769 to i16
  %1771 = zext i16 %1770 to i64
  call void @llvm.lifetime.end.p0(i64 18496, ptr nonnull %29)
  call void @llvm.lifetime.end.p0(i64 18496, ptr nonnull %28)
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %27)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %26)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %25)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %24)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %23)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %22)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %21)
  call void @llvm.lifetime.end.p0(i64 8704, ptr nonnull %20)
  call void @llvm.lifetime.end.p0(i64 1088, ptr nonnull %19)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %18)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %17)
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %16)
  %1772 = and i64 %1771, %111
  %1773 = icmp eq i64 %1772, 0
  br i1 %1773, label %1816, label %1779

1774:
  %1775 = phi i64 [ %1777, %1774 ], [ %72, %103 ]
  %1776 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1775
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %1776, ptr noundef nonnull align 16 dereferenceable(16) %31, i64 16, i1 false)
  %1777 = add nuw i64 %1775, 1
  %1778 = icmp eq i64 %1777, 16
  br i1 %1778, label %106, label %1774

1779:
  %1780 = phi i64 [ %1812, %1810 ], [ %109, %1766 ]
  %1781 = phi i64 [ %1814, %1810 ], [ %1772, %1766 ]
  %1782 = tail call range(i64 0, 65) i64 @llvm.ctlz.i64(i64 %1781, i1 true)
  %1783 = xor i64 %1782, 63
  %1784 = getelementptr inbounds [16 x %struct.SpanPiece], ptr %31, i64 0, i64 %1783
  %1785 = load i64, ptr %1784, align 16
  %1786 = getelementptr inbounds i8, ptr %1784, i64 8
  %1787 = load float, ptr %1786, align 8
  %1788 = getelementptr inbounds i8, ptr %1784, i64 12
  %1789 = load float, ptr %1788, align 4
  %1790 = fadd contract float %1787, %1789
  %1791 = fmul contract float %1790, 5.000000e-01
  %1792 = fcmp contract oeq float %1787, %1789
  br i1 %1792, label %1793, label %1796

1793:
  %1794 = getelementptr inbounds i8, ptr %5, i64 %1785
  store i8 1, ptr %1794, align 1
  %1795 = shl nuw nsw i64 1, %1783
  br label %1810

1796:
  %1797 = shl nuw nsw i64 1, %1783
  %1798 = and i64 %1797, %181
  %1799 = icmp eq i64 %1798, 0
  %1800 = add nsw i64 %1780, 1
  %1801 = getelementptr inbounds [4096 x %struct.SpanPiece], ptr %30, i64 0, i64 %1780
  store i64 %1785, ptr %1801, align 16
  %1802 = getelementptr inbounds i8, ptr %1801, i64 8
  %1803 = getelementptr inbounds i8, ptr %1801, i64 12
  br i1 %1799, label %1805, label %1804

1804:
  store float %1789, ptr %1802, align 8
  store float %1789, ptr %1803, align 4
  br label %1810

1805:
  store float %1791, ptr %1802, align 8
  store float %1789, ptr %1803, align 4
  %1806 = add nsw i64 %1780, 2
  %1807 = getelementptr inbounds [4096 x %struct.SpanPiece], ptr %30, i64 0, i64 %1800
  store i64 %1785, ptr %1807, align 16
  %1808 = getelementptr inbounds i8, ptr %1807, i64 8
  store float %1787, ptr %1808, align 8
  %1809 = getelementptr inbounds i8, ptr %1807, i64 12
  store float %1791, ptr %1809, align 4
  br label %1810

1810:
  %1811 = phi i64 [ %1797, %1804 ], [ %1797, %1805 ], [ %1795, %1793 ]
  %1812 = phi i64 [ %1800, %1804 ], [ %1806, %1805 ], [ %1780, %1793 ]
  %1813 = xor i64 %1811, -1
  %1814 = and i64 %1781, %1813
  %1815 = icmp eq i64 %1814, 0
  br i1 %1815, label %1816, label %1779

1816:
  %1817 = phi i64 [ %109, %1766 ], [ %1812, %1810 ]
  call void @llvm.lifetime.end.p0(i64 256, ptr nonnull %31)
  %1818 = icmp ne i64 %1817, 0
  %1819 = icmp slt i64 %108, %2
  %1820 = select i1 %1818, i1 true, i1 %1819
  br i1 %1820, label %61, label %1821

1821:
  %1822 = phi i64 [ %64, %105 ], [ 0, %33 ], [ 0, %6 ], [ %1767, %1816 ]
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %30)
  ret i64 %1822
}

declare void @llvm.memcpy.p0.p0.i64(ptr noalias nocapture writeonly, ptr noalias nocapture readonly, i64, i1 immarg)

declare i64 @llvm.ctlz.i64(i64, i1 immarg)

define i64 @search_route(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, i64 noundef %5, ptr nocapture noundef %6, ptr nocapture noundef writeonly %7) {
  %9 = alloca <16 x float>, align 64
  %10 = alloca <16 x float>, align 64
  %11 = alloca <16 x float>, align 64
  %12 = alloca <16 x float>, align 64
  %13 = alloca [2 x %struct.Tree], align 16
  %14 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  store i64 %5, ptr %14, align 8
  %15 = load <16 x float>, ptr %2, align 4
  call void @llvm.lifetime.start.p0(i64 48, ptr nonnull %13)
  %16 = getelementptr inbounds i8, ptr %1, i64 64
  %17 = load ptr, ptr %16, align 8
  store ptr %17, ptr %13, align 16
  %18 = getelementptr inbounds i8, ptr %13, i64 8
  %19 = getelementptr inbounds i8, ptr %1, i64 72
  %20 = load ptr, ptr %19, align 8
  store ptr %20, ptr %18, align 8
  %21 = getelementptr inbounds i8, ptr %13, i64 16
  %22 = getelementptr inbounds i8, ptr %13, i64 24
  %23 = getelementptr inbounds i8, ptr %1, i64 40
  %24 = load i64, ptr %23, align 8
  %25 = getelementptr inbounds <16 x float>, ptr %17, i64 %24
  store ptr %25, ptr %22, align 8
  %26 = getelementptr inbounds i8, ptr %13, i64 32
  %27 = getelementptr inbounds i32, ptr %20, i64 %24
  store ptr %27, ptr %26, align 16
  %28 = getelementptr inbounds i8, ptr %13, i64 40
  store i64 0, ptr %28, align 8
  store <16 x float> %15, ptr %17, align 4
  store i64 1, ptr %21, align 16
  store i32 -1, ptr %20, align 4
  %29 = icmp sgt i64 %4, 0
  br i1 %29, label %47, label %31

30:
  store i64 %4, ptr %28, align 8
  br label %31

31:
  %32 = load ptr, ptr %1, align 8
  %33 = load <16 x float>, ptr %32, align 4
  %34 = getelementptr inbounds i8, ptr %1, i64 8
  %35 = load ptr, ptr %34, align 8
  %36 = load <16 x float>, ptr %35, align 4
  %37 = getelementptr inbounds i8, ptr %1, i64 48
  %38 = load i64, ptr %37, align 8
  %39 = icmp sgt i64 %38, 0
  br i1 %39, label %40, label %433

40:
  %41 = getelementptr inbounds i8, ptr %1, i64 24
  %42 = getelementptr inbounds i8, ptr %1, i64 16
  %43 = getelementptr inbounds i8, ptr %1, i64 32
  %44 = getelementptr inbounds i8, ptr %1, i64 80
  %45 = getelementptr inbounds i8, ptr %1, i64 84
  %46 = getelementptr inbounds i8, ptr %1, i64 88
  br label %55

47:
  %48 = phi i64 [ %52, %47 ], [ 0, %8 ]
  %49 = getelementptr inbounds <16 x float>, ptr %3, i64 %48
  %50 = load <16 x float>, ptr %49, align 4
  %51 = getelementptr inbounds <16 x float>, ptr %25, i64 %48
  store <16 x float> %50, ptr %51, align 4
  %52 = add nuw nsw i64 %48, 1
  %53 = getelementptr inbounds i32, ptr %27, i64 %48
  store i32 -1, ptr %53, align 4
  %54 = icmp eq i64 %52, %4
  br i1 %54, label %30, label %47

55:
  %56 = phi i64 [ %38, %40 ], [ %430, %429 ]
  %57 = phi i64 [ %5, %40 ], [ %83, %429 ]
  %58 = phi i64 [ 0, %40 ], [ %431, %429 ]
  %59 = load i64, ptr %21, align 16
  %60 = load i64, ptr %28, align 8
  %61 = icmp sgt i64 %59, %60
  %62 = zext i1 %61 to i64
  %63 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %62
  %64 = xor i1 %61, true
  %65 = zext i1 %64 to i64
  %66 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %65
  %67 = getelementptr inbounds i8, ptr %63, i64 16
  %68 = load i64, ptr %67, align 8
  %69 = load i64, ptr %23, align 8
  %70 = icmp slt i64 %68, %69
  br i1 %70, label %71, label %433

71:
  %72 = getelementptr inbounds i8, ptr %66, i64 16
  %73 = load i64, ptr %72, align 8
  %74 = icmp slt i64 %73, %69
  br i1 %74, label %75, label %433

75:
  %76 = load i64, ptr %0, align 8
  %77 = icmp sgt i64 %76, 0
  br i1 %77, label %78, label %82

78:
  %79 = mul i64 %76, -7046029254386353131
  br label %185

80:
  %81 = add i64 %79, %57
  br label %82

82:
  %83 = phi i64 [ %57, %75 ], [ %81, %80 ]
  %84 = phi <16 x float> [ %33, %75 ], [ %205, %80 ]
  %85 = load ptr, ptr %63, align 8
  %86 = load ptr, ptr %41, align 8
  %87 = load <16 x float>, ptr %86, align 4
  %88 = fcmp contract oeq <16 x float> %87, zeroinitializer
  %89 = select contract <16 x i1> %88, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %90 = fadd contract <16 x float> %87, %89
  %91 = load ptr, ptr %42, align 8
  %92 = load <16 x float>, ptr %91, align 4
  %93 = icmp sgt i64 %68, 1
  br i1 %93, label %94, label %149

94:
  %95 = load <16 x float>, ptr %85, align 4
  %96 = fsub contract <16 x float> %84, %95
  %97 = fdiv contract <16 x float> %96, %90
  %98 = fadd contract <16 x float> %97, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %99 = fadd contract <16 x float> %98, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %100 = fmul contract <16 x float> %87, %99
  %101 = fsub contract <16 x float> %96, %100
  %102 = fmul contract <16 x float> %92, %101
  %103 = fmul contract <16 x float> %102, %102
  %104 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %105 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %106 = fadd contract <8 x float> %104, %105
  %107 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %108 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %109 = fadd contract <4 x float> %107, %108
  %110 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %111 = fadd contract <4 x float> %109, %110
  %112 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %113 = fadd contract <4 x float> %109, %112
  %114 = shufflevector <4 x float> %113, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %115 = fadd contract <4 x float> %111, %114
  %116 = extractelement <4 x float> %115, i64 0
  br label %117

117:
  %118 = phi i64 [ %146, %117 ], [ 0, %94 ]
  %119 = phi i64 [ %147, %117 ], [ 1, %94 ]
  %120 = phi float [ %145, %117 ], [ %116, %94 ]
  %121 = getelementptr inbounds <16 x float>, ptr %85, i64 %119
  %122 = load <16 x float>, ptr %121, align 4
  %123 = fsub contract <16 x float> %84, %122
  %124 = fdiv contract <16 x float> %123, %90
  %125 = fadd contract <16 x float> %124, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %126 = fadd contract <16 x float> %125, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %127 = fmul contract <16 x float> %87, %126
  %128 = fsub contract <16 x float> %123, %127
  %129 = fmul contract <16 x float> %92, %128
  %130 = fmul contract <16 x float> %129, %129
  %131 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %132 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %133 = fadd contract <8 x float> %131, %132
  %134 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %135 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %136 = fadd contract <4 x float> %134, %135
  %137 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %138 = fadd contract <4 x float> %136, %137
  %139 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %140 = fadd contract <4 x float> %136, %139
  %141 = shufflevector <4 x float> %140, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %142 = fadd contract <4 x float> %138, %141
  %143 = extractelement <4 x float> %142, i64 0
  %144 = fcmp contract olt float %143, %120
  %145 = select i1 %144, float %143, float %120
  %146 = select i1 %144, i64 %119, i64 %118
  %147 = add nuw nsw i64 %119, 1
  %148 = icmp eq i64 %147, %68
  br i1 %148, label %149, label %117

149:
  %150 = phi i64 [ 0, %82 ], [ %146, %117 ]
  %151 = getelementptr inbounds <16 x float>, ptr %85, i64 %150
  %152 = load <16 x float>, ptr %151, align 4
  %153 = fsub contract <16 x float> %84, %152
  %154 = fdiv contract <16 x float> %153, %90
  %155 = fadd contract <16 x float> %154, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %156 = fadd contract <16 x float> %155, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %157 = fmul contract <16 x float> %87, %156
  %158 = fsub contract <16 x float> %153, %157
  %159 = load i64, ptr %43, align 8
  %160 = icmp eq i64 %159, 0
  %161 = fmul contract <16 x float> %92, %158
  br i1 %160, label %162, label %178

162:
  %163 = fmul contract <16 x float> %161, %161
  %164 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %165 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %166 = fadd contract <8 x float> %164, %165
  %167 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %168 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %169, %170
  %172 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = shufflevector <4 x float> %173, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %175 = fadd contract <4 x float> %171, %174
  %176 = extractelement <4 x float> %175, i64 0
  %177 = tail call contract float @llvm.sqrt.f32(float %176)
  br label %181

178:
  %179 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %161)
  %180 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %179)
  br label %181

181:
  %182 = phi float [ %180, %178 ], [ %177, %162 ]
  %183 = load float, ptr %44, align 8
  %184 = fcmp contract ogt float %182, %183
  br i1 %184, label %208, label %213

185:
  %186 = phi i64 [ %192, %185 ], [ %57, %78 ]
  %187 = phi <16 x float> [ %205, %185 ], [ %33, %78 ]
  %188 = phi i64 [ %206, %185 ], [ 0, %78 ]
  %189 = extractelement <16 x float> %36, i64 %188
  %190 = extractelement <16 x float> %33, i64 %188
  %191 = fsub contract float %189, %190
  %192 = add i64 %186, -7046029254386353131
  %193 = lshr i64 %192, 30
  %194 = xor i64 %193, %192
  %195 = mul i64 %194, -4658895280553007687
  %196 = lshr i64 %195, 27
  %197 = xor i64 %196, %195
  %198 = mul i64 %197, -7723592293110705685
  %199 = lshr i64 %198, 40
  %200 = uitofp nneg i64 %199 to float
  %201 = fmul contract float %200, 0x3E70000000000000
  %202 = fmul contract float %191, %201
  %203 = extractelement <16 x float> %187, i64 %188
  %204 = fadd contract float %203, %202
  %205 = insertelement <16 x float> %187, float %204, i64 %188
  %206 = add nuw nsw i64 %188, 1
  %207 = icmp eq i64 %206, %76
  br i1 %207, label %80, label %185

208:
  %209 = fdiv contract float %183, %182
  %210 = insertelement <16 x float> poison, float %209, i64 0
  %211 = shufflevector <16 x float> %210, <16 x float> poison, <16 x i32> zeroinitializer
  %212 = fmul contract <16 x float> %158, %211
  br label %213

213:
  %214 = phi <16 x float> [ %212, %208 ], [ %158, %181 ]
  %215 = fcmp contract oeq float %182, 0.000000e+00
  br i1 %215, label %429, label %216

216:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %10)
  store <16 x float> %152, ptr %9, align 64
  store <16 x float> %214, ptr %10, align 64
  %217 = load float, ptr %45, align 4
  %218 = load float, ptr %46, align 8
  %219 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %9, ptr noundef nonnull %10, float noundef %217, float noundef %218)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %10)
  br i1 %219, label %220, label %429

220:
  %221 = fadd contract <16 x float> %152, %214
  %222 = getelementptr inbounds <16 x float>, ptr %85, i64 %68
  store <16 x float> %221, ptr %222, align 4
  %223 = trunc i64 %150 to i32
  %224 = getelementptr inbounds i8, ptr %63, i64 8
  %225 = load ptr, ptr %224, align 8
  %226 = add nsw i64 %68, 1
  store i64 %226, ptr %67, align 8
  %227 = getelementptr inbounds i32, ptr %225, i64 %68
  store i32 %223, ptr %227, align 4
  %228 = getelementptr <16 x float>, ptr %85, i64 %226
  %229 = getelementptr i8, ptr %228, i64 -64
  %230 = load <16 x float>, ptr %229, align 4
  %231 = load ptr, ptr %66, align 8
  %232 = load ptr, ptr %41, align 8
  %233 = load <16 x float>, ptr %232, align 4
  %234 = fcmp contract oeq <16 x float> %233, zeroinitializer
  %235 = select contract <16 x i1> %234, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %236 = fadd contract <16 x float> %233, %235
  %237 = load ptr, ptr %42, align 8
  %238 = load <16 x float>, ptr %237, align 4
  %239 = icmp sgt i64 %73, 1
  br i1 %239, label %240, label %295

240:
  %241 = load <16 x float>, ptr %231, align 4
  %242 = fsub contract <16 x float> %230, %241
  %243 = fdiv contract <16 x float> %242, %236
  %244 = fadd contract <16 x float> %243, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %245 = fadd contract <16 x float> %244, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %246 = fmul contract <16 x float> %233, %245
  %247 = fsub contract <16 x float> %242, %246
  %248 = fmul contract <16 x float> %238, %247
  %249 = fmul contract <16 x float> %248, %248
  %250 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %251 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %252 = fadd contract <8 x float> %250, %251
  %253 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %254 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %255 = fadd contract <4 x float> %253, %254
  %256 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %257 = fadd contract <4 x float> %255, %256
  %258 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %259 = fadd contract <4 x float> %255, %258
  %260 = shufflevector <4 x float> %259, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %261 = fadd contract <4 x float> %257, %260
  %262 = extractelement <4 x float> %261, i64 0
  br label %263

263:
  %264 = phi i64 [ %292, %263 ], [ 0, %240 ]
  %265 = phi i64 [ %293, %263 ], [ 1, %240 ]
  %266 = phi float [ %291, %263 ], [ %262, %240 ]
  %267 = getelementptr inbounds <16 x float>, ptr %231, i64 %265
  %268 = load <16 x float>, ptr %267, align 4
  %269 = fsub contract <16 x float> %230, %268
  %270 = fdiv contract <16 x float> %269, %236
  %271 = fadd contract <16 x float> %270, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %272 = fadd contract <16 x float> %271, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %273 = fmul contract <16 x float> %233, %272
  %274 = fsub contract <16 x float> %269, %273
  %275 = fmul contract <16 x float> %238, %274
  %276 = fmul contract <16 x float> %275, %275
  %277 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %278 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %279 = fadd contract <8 x float> %277, %278
  %280 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %281 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %282 = fadd contract <4 x float> %280, %281
  %283 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %284 = fadd contract <4 x float> %282, %283
  %285 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %286 = fadd contract <4 x float> %282, %285
  %287 = shufflevector <4 x float> %286, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %288 = fadd contract <4 x float> %284, %287
  %289 = extractelement <4 x float> %288, i64 0
  %290 = fcmp contract olt float %289, %266
  %291 = select i1 %290, float %289, float %266
  %292 = select i1 %290, i64 %265, i64 %264
  %293 = add nuw nsw i64 %265, 1
  %294 = icmp eq i64 %293, %73
  br i1 %294, label %295, label %263

295:
  %296 = phi i64 [ 0, %220 ], [ %292, %263 ]
  %297 = getelementptr inbounds i8, ptr %66, i64 8
  br label %298

298:
  %299 = phi i64 [ %73, %295 ], [ %425, %424 ]
  %300 = phi i64 [ %296, %295 ], [ %426, %424 ]
  %301 = getelementptr inbounds <16 x float>, ptr %231, i64 %300
  %302 = load <16 x float>, ptr %301, align 4
  %303 = fsub contract <16 x float> %230, %302
  %304 = load ptr, ptr %41, align 8
  %305 = load <16 x float>, ptr %304, align 4
  %306 = fcmp contract oeq <16 x float> %305, zeroinitializer
  %307 = select contract <16 x i1> %306, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %308 = fadd contract <16 x float> %305, %307
  %309 = fdiv contract <16 x float> %303, %308
  %310 = fadd contract <16 x float> %309, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %311 = fadd contract <16 x float> %310, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %312 = fmul contract <16 x float> %305, %311
  %313 = fsub contract <16 x float> %303, %312
  %314 = load i64, ptr %43, align 8
  %315 = icmp eq i64 %314, 0
  %316 = load ptr, ptr %42, align 8
  %317 = load <16 x float>, ptr %316, align 4
  %318 = fmul contract <16 x float> %317, %313
  br i1 %315, label %319, label %335

319:
  %320 = fmul contract <16 x float> %318, %318
  %321 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %322 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %323 = fadd contract <8 x float> %321, %322
  %324 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %325 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %326 = fadd contract <4 x float> %324, %325
  %327 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %328 = fadd contract <4 x float> %326, %327
  %329 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %330 = fadd contract <4 x float> %326, %329
  %331 = shufflevector <4 x float> %330, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %332 = fadd contract <4 x float> %328, %331
  %333 = extractelement <4 x float> %332, i64 0
  %334 = tail call contract float @llvm.sqrt.f32(float %333)
  br label %338

335:
  %336 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %318)
  %337 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %336)
  br label %338

338:
  %339 = phi float [ %337, %335 ], [ %334, %319 ]
  %340 = load float, ptr %44, align 8
  %341 = fcmp contract ugt float %339, %340
  br i1 %341, label %342, label %347

342:
  %343 = fdiv contract float %340, %339
  %344 = insertelement <16 x float> poison, float %343, i64 0
  %345 = shufflevector <16 x float> %344, <16 x float> poison, <16 x i32> zeroinitializer
  %346 = fmul contract <16 x float> %313, %345
  br label %347

347:
  %348 = phi <16 x float> [ %313, %338 ], [ %346, %342 ]
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %12)
  store <16 x float> %302, ptr %11, align 64
  store <16 x float> %348, ptr %12, align 64
  %349 = load float, ptr %45, align 4
  %350 = load float, ptr %46, align 8
  %351 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %11, ptr noundef nonnull %12, float noundef %349, float noundef %350)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %12)
  br i1 %351, label %352, label %427

352:
  br i1 %341, label %414, label %353

353:
  %354 = select i1 %61, i64 %300, i64 %68
  %355 = select i1 %61, i64 %68, i64 %300
  %356 = icmp slt i64 %354, 0
  br i1 %356, label %375, label %362

357:
  %358 = lshr i64 %369, 1
  %359 = icmp eq i64 %364, 0
  br i1 %359, label %375, label %360

360:
  %361 = getelementptr <16 x float>, ptr %6, i64 %369
  br label %378

362:
  %363 = phi i64 [ %373, %366 ], [ %354, %353 ]
  %364 = phi i64 [ %369, %366 ], [ 0, %353 ]
  %365 = icmp eq i64 %364, 256
  br i1 %365, label %433, label %366

366:
  %367 = getelementptr inbounds <16 x float>, ptr %17, i64 %363
  %368 = load <16 x float>, ptr %367, align 4
  %369 = add nuw nsw i64 %364, 1
  %370 = getelementptr inbounds <16 x float>, ptr %6, i64 %364
  store <16 x float> %368, ptr %370, align 4
  %371 = getelementptr inbounds i32, ptr %20, i64 %363
  %372 = load i32, ptr %371, align 4
  %373 = zext nneg i32 %372 to i64
  %374 = icmp slt i32 %372, 0
  br i1 %374, label %357, label %362

375:
  %376 = phi i64 [ 1, %357 ], [ 0, %353 ], [ %369, %378 ]
  %377 = icmp slt i64 %355, 0
  br i1 %377, label %435, label %387

378:
  %379 = phi i64 [ 0, %360 ], [ %385, %378 ]
  %380 = xor i64 %379, -1
  %381 = getelementptr <16 x float>, ptr %361, i64 %380
  %382 = load <16 x float>, ptr %381, align 4
  %383 = getelementptr inbounds <16 x float>, ptr %6, i64 %379
  %384 = load <16 x float>, ptr %383, align 4
  store <16 x float> %384, ptr %381, align 4
  store <16 x float> %382, ptr %383, align 4
  %385 = add nuw nsw i64 %379, 1
  %386 = icmp eq i64 %385, %358
  br i1 %386, label %375, label %378

387:
  %388 = phi i64 [ %412, %391 ], [ %355, %375 ]
  %389 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %388, ptr %7, align 8
  %390 = icmp eq i64 %389, 256
  br i1 %390, label %424, label %391

391:
  %392 = getelementptr <16 x float>, ptr %6, i64 %389
  %393 = getelementptr i8, ptr %392, i64 -64
  %394 = load <16 x float>, ptr %393, align 4
  %395 = getelementptr inbounds <16 x float>, ptr %25, i64 %388
  %396 = load <16 x float>, ptr %395, align 4
  %397 = fsub contract <16 x float> %396, %394
  %398 = load ptr, ptr %41, align 8
  %399 = load <16 x float>, ptr %398, align 4
  %400 = fcmp contract oeq <16 x float> %399, zeroinitializer
  %401 = select contract <16 x i1> %400, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %402 = fadd contract <16 x float> %399, %401
  %403 = fdiv contract <16 x float> %397, %402
  %404 = fadd contract <16 x float> %403, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %405 = fadd contract <16 x float> %404, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %406 = fmul contract <16 x float> %399, %405
  %407 = fsub contract <16 x float> %397, %406
  %408 = fadd contract <16 x float> %394, %407
  store <16 x float> %408, ptr %392, align 4
  %409 = add nuw nsw i64 %389, 1
  %410 = getelementptr inbounds i32, ptr %27, i64 %388
  %411 = load i32, ptr %410, align 4
  %412 = zext nneg i32 %411 to i64
  %413 = icmp slt i32 %411, 0
  br i1 %413, label %435, label %387

414:
  %415 = load i64, ptr %23, align 8
  %416 = icmp slt i64 %299, %415
  br i1 %416, label %417, label %427

417:
  %418 = fadd contract <16 x float> %302, %348
  %419 = getelementptr inbounds <16 x float>, ptr %231, i64 %299
  store <16 x float> %418, ptr %419, align 4
  %420 = trunc i64 %300 to i32
  %421 = load ptr, ptr %297, align 8
  %422 = add nsw i64 %299, 1
  store i64 %422, ptr %72, align 8
  %423 = getelementptr inbounds i32, ptr %421, i64 %299
  store i32 %420, ptr %423, align 4
  br label %424

424:
  %425 = phi i64 [ %422, %417 ], [ %299, %387 ]
  %426 = phi i64 [ %299, %417 ], [ %300, %387 ]
  br i1 %341, label %298, label %433

427:
  %428 = load i64, ptr %37, align 8
  br label %429

429:
  %430 = phi i64 [ %428, %427 ], [ %56, %216 ], [ %56, %213 ]
  %431 = add nuw nsw i64 %58, 1
  %432 = icmp slt i64 %431, %430
  br i1 %432, label %55, label %433

433:
  %434 = phi i64 [ 0, %31 ], [ -1, %362 ], [ -1, %424 ], [ 0, %429 ], [ 0, %71 ], [ 0, %55 ]
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  br label %440

435:
  %436 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %83, ptr %14, align 8
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  %437 = icmp sgt i64 %436, 2
  br i1 %437, label %438, label %440

438:
  %439 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %14, ptr noundef %6, i64 noundef %436)
  br label %440

440:
  %441 = phi i64 [ %439, %438 ], [ %436, %435 ], [ %434, %433 ]
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  ret i64 %441
}

define internal fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef nonnull readonly align 8 dereferenceable(96) %1, ptr nocapture noundef nonnull align 8 dereferenceable(8) %2, ptr nocapture noundef %3, i64 noundef %4) unnamed_addr {
  %6 = alloca <16 x float>, align 64
  %7 = alloca <16 x float>, align 64
  %8 = alloca <16 x float>, align 64
  %9 = alloca <16 x float>, align 64
  %10 = alloca [256 x float], align 16
  %11 = alloca float, align 4
  %12 = alloca float, align 4
  %13 = alloca i64, align 16
  %14 = alloca i64, align 8
  %15 = alloca <16 x float>, align 64
  %16 = alloca <16 x float>, align 64
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %10)
  %17 = icmp sgt i64 %4, 2
  br i1 %17, label %18, label %268

18:
  %19 = getelementptr inbounds i8, ptr %1, i64 84
  %20 = getelementptr inbounds i8, ptr %1, i64 88
  br label %21

21:
  %22 = phi i64 [ %4, %18 ], [ %66, %65 ]
  %23 = phi i64 [ 0, %18 ], [ %24, %65 ]
  %24 = add nuw nsw i64 %23, 1
  %25 = getelementptr inbounds <16 x float>, ptr %3, i64 %23
  %26 = load float, ptr %19, align 4
  %27 = load float, ptr %20, align 8
  br label %39

28:
  %29 = getelementptr inbounds i8, ptr %1, i64 56
  %30 = icmp sgt i64 %66, 2
  %31 = load i64, ptr %29, align 8
  %32 = icmp sgt i64 %31, 0
  %33 = select i1 %30, i1 %32, i1 false
  br i1 %33, label %34, label %268

34:
  %35 = getelementptr inbounds i8, ptr %1, i64 32
  %36 = getelementptr inbounds i8, ptr %1, i64 16
  %37 = getelementptr inbounds i8, ptr %1, i64 84
  %38 = getelementptr inbounds i8, ptr %1, i64 88
  br label %69

39:
  %40 = phi i64 [ %41, %43 ], [ %22, %21 ]
  %41 = add nsw i64 %40, -1
  %42 = icmp sgt i64 %41, %24
  br i1 %42, label %43, label %65

43:
  %44 = load <16 x float>, ptr %25, align 4
  %45 = getelementptr inbounds <16 x float>, ptr %3, i64 %41
  %46 = load <16 x float>, ptr %45, align 4
  %47 = fsub contract <16 x float> %46, %44
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %7)
  store <16 x float> %44, ptr %6, align 64
  store <16 x float> %47, ptr %7, align 64
  %48 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %6, ptr noundef nonnull %7, float noundef %26, float noundef %27)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %7)
  br i1 %48, label %49, label %39

49:
  %50 = sub i64 1, %40
  %51 = icmp sgt i64 %40, %22
  br i1 %51, label %55, label %52

52:
  %53 = getelementptr <16 x float>, ptr %3, i64 %50
  %54 = getelementptr <16 x float>, ptr %53, i64 %24
  br label %58

55:
  %56 = add i64 %22, %24
  %57 = add i64 %56, %50
  br label %65

58:
  %59 = phi i64 [ %41, %52 ], [ %63, %58 ]
  %60 = getelementptr inbounds <16 x float>, ptr %3, i64 %59
  %61 = load <16 x float>, ptr %60, align 4
  %62 = getelementptr <16 x float>, ptr %54, i64 %59
  store <16 x float> %61, ptr %62, align 4
  %63 = add nsw i64 %59, 1
  %64 = icmp eq i64 %63, %22
  br i1 %64, label %55, label %58

65:
  %66 = phi i64 [ %57, %55 ], [ %22, %39 ]
  %67 = add nuw nsw i64 %23, 3
  %68 = icmp slt i64 %67, %66
  br i1 %68, label %21, label %28

69:
  %70 = phi i64 [ %66, %34 ], [ %263, %261 ]
  %71 = phi i64 [ 0, %34 ], [ %262, %261 ]
  store float 0.000000e+00, ptr %10, align 16
  %72 = load i64, ptr %35, align 8
  %73 = icmp eq i64 %72, 0
  %74 = load ptr, ptr %36, align 8
  %75 = load <16 x float>, ptr %3, align 4
  %76 = load <16 x float>, ptr %74, align 4
  br label %105

77:
  %78 = add nsw i64 %70, -1
  %79 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %78
  %80 = load float, ptr %79, align 4
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %12)
  %81 = load i64, ptr %2, align 8
  %82 = add i64 %81, -7046029254386353131
  %83 = lshr i64 %82, 30
  %84 = xor i64 %83, %82
  %85 = mul i64 %84, -4658895280553007687
  %86 = lshr i64 %85, 27
  %87 = xor i64 %86, %85
  %88 = mul i64 %87, -7723592293110705685
  %89 = lshr i64 %88, 40
  %90 = uitofp nneg i64 %89 to float
  %91 = fmul contract float %90, 0x3E70000000000000
  %92 = fmul contract float %80, %91
  store float %92, ptr %11, align 4
  %93 = add i64 %81, 4354685564936845354
  store i64 %93, ptr %2, align 8
  %94 = lshr i64 %93, 30
  %95 = xor i64 %94, %93
  %96 = mul i64 %95, -4658895280553007687
  %97 = lshr i64 %96, 27
  %98 = xor i64 %97, %96
  %99 = mul i64 %98, -7723592293110705685
  %100 = lshr i64 %99, 40
  %101 = uitofp nneg i64 %100 to float
  %102 = fmul contract float %101, 0x3E70000000000000
  %103 = fmul contract float %80, %102
  store float %103, ptr %12, align 4
  %104 = fcmp contract ogt float %92, %103
  br i1 %104, label %138, label %139

105:
  %106 = phi <16 x float> [ %75, %69 ], [ %110, %132 ]
  %107 = phi float [ 0.000000e+00, %69 ], [ %134, %132 ]
  %108 = phi i64 [ 1, %69 ], [ %136, %132 ]
  %109 = getelementptr inbounds <16 x float>, ptr %3, i64 %108
  %110 = load <16 x float>, ptr %109, align 4
  %111 = fsub contract <16 x float> %110, %106
  %112 = fmul contract <16 x float> %111, %76
  br i1 %73, label %113, label %129

113:
  %114 = fmul contract <16 x float> %112, %112
  %115 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %116 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %117 = fadd contract <8 x float> %115, %116
  %118 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %119 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %120 = fadd contract <4 x float> %118, %119
  %121 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %122 = fadd contract <4 x float> %120, %121
  %123 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %124 = fadd contract <4 x float> %120, %123
  %125 = shufflevector <4 x float> %124, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %126 = fadd contract <4 x float> %122, %125
  %127 = extractelement <4 x float> %126, i64 0
  %128 = tail call contract float @llvm.sqrt.f32(float %127)
  br label %132

129:
  %130 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %112)
  %131 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %130)
  br label %132

132:
  %133 = phi float [ %131, %129 ], [ %128, %113 ]
  %134 = fadd contract float %107, %133
  %135 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %108
  store float %134, ptr %135, align 4
  %136 = add nuw nsw i64 %108, 1
  %137 = icmp eq i64 %136, %70
  br i1 %137, label %77, label %105

138:
  store float %103, ptr %11, align 4
  store float %92, ptr %12, align 4
  br label %139

139:
  %140 = phi float [ %103, %138 ], [ %92, %77 ]
  %141 = phi float [ %92, %138 ], [ %103, %77 ]
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %16)
  %142 = add nsw i64 %70, -2
  %143 = add nsw i64 %70, -1
  %144 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %143
  br label %145

145:
  %146 = phi i1 [ true, %139 ], [ false, %213 ]
  %147 = phi ptr [ %15, %139 ], [ %16, %213 ]
  %148 = phi ptr [ %13, %139 ], [ %14, %213 ]
  %149 = phi ptr [ %11, %139 ], [ %12, %213 ]
  br label %190

150:
  %151 = fsub contract float %141, %140
  %152 = load <16 x float>, ptr %16, align 64
  %153 = load <16 x float>, ptr %15, align 64
  %154 = fsub contract <16 x float> %152, %153
  %155 = load i64, ptr %35, align 8
  %156 = icmp eq i64 %155, 0
  %157 = load ptr, ptr %36, align 8
  %158 = load <16 x float>, ptr %157, align 4
  %159 = fmul contract <16 x float> %154, %158
  br i1 %156, label %160, label %176

160:
  %161 = fmul contract <16 x float> %159, %159
  %162 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %163 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %164 = fadd contract <8 x float> %162, %163
  %165 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %166 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %167 = fadd contract <4 x float> %165, %166
  %168 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %167, %170
  %172 = shufflevector <4 x float> %171, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = extractelement <4 x float> %173, i64 0
  %175 = tail call contract float @llvm.sqrt.f32(float %174)
  br label %179

176:
  %177 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %159)
  %178 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %177)
  br label %179

179:
  %180 = phi float [ %178, %176 ], [ %175, %160 ]
  %181 = fsub contract float %151, %180
  %182 = load i64, ptr %13, align 16
  %183 = load i64, ptr %14, align 8
  %184 = icmp eq i64 %182, %183
  %185 = fmul contract float %80, 0x3F1A36E2E0000000
  %186 = fcmp contract olt float %181, %185
  %187 = select i1 %184, i1 true, i1 %186
  %188 = icmp sgt i64 %70, 254
  %189 = or i1 %188, %187
  br i1 %189, label %228, label %224

190:
  %191 = phi i64 [ %196, %195 ], [ 0, %145 ]
  %192 = icmp eq i64 %191, %142
  br i1 %192, label %193, label %195

193:
  %194 = load float, ptr %144, align 4
  br label %201

195:
  %196 = add nuw nsw i64 %191, 1
  %197 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %196
  %198 = load float, ptr %197, align 4
  %199 = load float, ptr %149, align 4
  %200 = fcmp contract olt float %198, %199
  br i1 %200, label %190, label %201

201:
  %202 = phi float [ %194, %193 ], [ %198, %195 ]
  %203 = phi i64 [ %143, %193 ], [ %196, %195 ]
  %204 = phi i64 [ %142, %193 ], [ %191, %195 ]
  %205 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %204
  %206 = load float, ptr %205, align 4
  %207 = fsub contract float %202, %206
  %208 = fcmp contract ogt float %207, 0.000000e+00
  br i1 %208, label %209, label %213

209:
  %210 = load float, ptr %149, align 4
  %211 = fsub contract float %210, %206
  %212 = fdiv contract float %211, %207
  br label %213

213:
  %214 = phi contract float [ %212, %209 ], [ 0.000000e+00, %201 ]
  %215 = getelementptr inbounds <16 x float>, ptr %3, i64 %204
  %216 = load <16 x float>, ptr %215, align 4
  %217 = insertelement <16 x float> poison, float %214, i64 0
  %218 = shufflevector <16 x float> %217, <16 x float> poison, <16 x i32> zeroinitializer
  %219 = getelementptr inbounds <16 x float>, ptr %3, i64 %203
  %220 = load <16 x float>, ptr %219, align 4
  %221 = fsub contract <16 x float> %220, %216
  %222 = fmul contract <16 x float> %218, %221
  %223 = fadd contract <16 x float> %216, %222
  store <16 x float> %223, ptr %147, align 64
  store i64 %204, ptr %148, align 8
  br i1 %146, label %145, label %150

224:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  store <16 x float> %153, ptr %8, align 64
  store <16 x float> %154, ptr %9, align 64
  %225 = load float, ptr %37, align 4
  %226 = load float, ptr %38, align 8
  %227 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %8, ptr noundef nonnull %9, float noundef %225, float noundef %226)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  br i1 %227, label %230, label %228

228:
  %229 = add nsw i64 %71, 1
  br label %261

230:
  %231 = fmul contract float %80, 0x3F847AE140000000
  %232 = fcmp contract ogt float %181, %231
  %233 = select i1 %232, i64 0, i64 %71
  %234 = sub i64 %182, %183
  %235 = add i64 %234, 2
  %236 = icmp sgt i64 %235, 0
  br i1 %236, label %240, label %237

237:
  %238 = add nsw i64 %183, 1
  %239 = icmp slt i64 %238, %70
  br i1 %239, label %249, label %256

240:
  %241 = icmp sgt i64 %78, %183
  br i1 %241, label %242, label %256

242:
  %243 = phi i64 [ %247, %242 ], [ %78, %240 ]
  %244 = getelementptr inbounds <16 x float>, ptr %3, i64 %243
  %245 = load <16 x float>, ptr %244, align 4
  %246 = getelementptr <16 x float>, ptr %244, i64 %235
  store <16 x float> %245, ptr %246, align 4
  %247 = add nsw i64 %243, -1
  %248 = icmp sgt i64 %247, %183
  br i1 %248, label %242, label %256

249:
  %250 = phi i64 [ %254, %249 ], [ %238, %237 ]
  %251 = getelementptr inbounds <16 x float>, ptr %3, i64 %250
  %252 = load <16 x float>, ptr %251, align 4
  %253 = getelementptr <16 x float>, ptr %251, i64 %235
  store <16 x float> %252, ptr %253, align 4
  %254 = add nsw i64 %250, 1
  %255 = icmp eq i64 %254, %70
  br i1 %255, label %256, label %249

256:
  %257 = getelementptr <16 x float>, ptr %3, i64 %182
  %258 = getelementptr i8, ptr %257, i64 64
  store <16 x float> %153, ptr %258, align 4
  %259 = getelementptr i8, ptr %257, i64 128
  store <16 x float> %152, ptr %259, align 4
  %260 = add nsw i64 %235, %70
  br label %261

261:
  %262 = phi i64 [ %229, %228 ], [ %233, %256 ]
  %263 = phi i64 [ %70, %228 ], [ %260, %256 ]
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %16)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %12)
  %264 = icmp sgt i64 %263, 2
  %265 = load i64, ptr %29, align 8
  %266 = icmp slt i64 %262, %265
  %267 = select i1 %264, i1 %266, i1 false
  br i1 %267, label %69, label %268

268:
  %269 = phi i64 [ %66, %28 ], [ %4, %5 ], [ %263, %261 ]
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %10)
  ret i64 %269
}

define noundef i64 @shorten(ptr nocapture noundef nonnull readonly %0, ptr nocapture noundef nonnull readonly %1, ptr nocapture noundef %2, i64 noundef %3, i64 noundef %4) {
  %6 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %6)
  store i64 %4, ptr %6, align 8
  %7 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %6, ptr noundef %2, i64 noundef %3)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %6)
  ret i64 %7
}

declare <16 x float> @llvm.fabs.v16f32(<16 x float>)

declare <16 x float> @llvm.sqrt.v16f32(<16 x float>)

declare <8 x double> @llvm.fabs.v8f64(<8 x double>)

declare <8 x double> @llvm.sqrt.v8f64(<8 x double>)

declare float @llvm.sqrt.f32(float)

declare float @llvm.vector.reduce.fmax.v16f32(<16 x float>)

declare i64 @llvm.cttz.i64(i64, i1 immarg)

declare i64 @llvm.smin.i64(i64, i64)

declare i64 @llvm.umax.i64(i64, i64)



